// The five rules of #include.
#include "cocos/text/ChunkLibrary.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/Files.h"
#include "core/Text.h"

namespace crevice::cocos {
namespace {

namespace fs = std::filesystem;

fs::path realPath(const fs::path& path) {
    std::error_code error;
    const fs::path real = fs::weakly_canonical(path, error);
    return error ? path : real;
}

bool isInside(const fs::path& real, const fs::path& folder) {
    if (folder.empty()) return false;
    const fs::path relative = real.lexically_relative(folder);
    return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

ChunkLibrary::Found ChunkLibrary::find(const EffectAsset& effect, const std::string& name, const fs::path& folder) {
    if (effect.programs.contains(name)) return {readProgram(effect, name), {}};
    auto& known = found_[folder.native()];
    if (const auto it = known.find(name); it != known.end()) return it->second;
    Found found;
    if (name.starts_with('/') || name.find('\0') != std::string::npos) {
        found.help = "names of chunks are relative";
    } else if (name.starts_with('.')) {
        found = findRelative(effect, name, folder);
    } else if (const auto* entry = index().find(name)) {
        found.source = readFile(entry->path, name);
    } else if (const SourceText* beside = readBeside(name, folder); beside && mayRead(beside->file, effect)) {
        found.source = beside;
    } else {
        const auto ending = index().endingWith(name);
        if (ending.size() == 1) found.source = readFile(ending.front()->path, name);
        if (ending.size() > 1)
            found.help = fmt::format("'{}' and '{}' both end so: name more of the path", ending[0]->path.string(),
                                     ending[1]->path.string());
    }
    if (found.source == nullptr && found.help.empty()) {
        std::vector<std::string> all = index().names();
        for (const auto& [program, text] : effect.programs) all.push_back(program);
        const auto near = nearestNames(name, all);
        if (!near.empty()) found.help = fmt::format("did you mean '{}'? ", join(near, "', '"));
        found.help += "chunk folders: ";
        std::vector<std::string> folders;
        for (const fs::path& path : roots_.chunkFolders()) folders.push_back(path.string());
        found.help += folders.empty() ? "none; give --project, --engine or --chunks" : join(folders);
        if (!folders.empty() && roots_.engine.empty()) found.help += "; the engine's own come with --engine DIR";
    }
    return known[name] = found;
}

ChunkLibrary::ChunkLibrary(const Roots& roots) : roots_(roots), engine_(realPath(roots.engine)) {
    for (const fs::path& folder : {roots.project, roots.engine})
        if (!folder.empty()) own_.push_back(realPath(folder));
    for (const fs::path& folder : roots.chunks)
        if (!folder.empty()) own_.push_back(realPath(folder));
}

bool ChunkLibrary::isOfEngine(const SourceText& source) const { return isInside(realPath(source.file), engine_); }

/// A name with a dot in front. It is meant from the including file; Cocos' own effects also write it as seen from the
/// chunk folder (`../effects/advanced/common-functions`) or from a folder the file once stood in.
ChunkLibrary::Found ChunkLibrary::findRelative(const EffectAsset& effect, const std::string& name,
                                               const fs::path& folder) {
    Found found;
    const fs::path path = (folder / (name + ".chunk")).lexically_normal();
    if (!mayRead(path, effect))
        found.help = "the path leads out of the project, the engine and the chunk folders";
    else if ((found.source = readBeside(name, folder)) == nullptr)
        found.help = fmt::format("looked for {}", path.string());
    for (const fs::path& chunks : roots_.chunkFolders()) {
        if (found.source != nullptr) return found;
        if (mayRead((chunks / (name + ".chunk")).lexically_normal(), effect)) found.source = readBeside(name, chunks);
    }
    if (found.source != nullptr) return found;
    std::string_view tail = name;
    while (tail.starts_with("./") || tail.starts_with("../")) tail.remove_prefix(tail.find('/') + 1);
    const auto ending = index().endingWith(tail);
    if (ending.size() == 1) found.source = readFile(ending.front()->path, name);
    return found;
}

/// Files of the author's own folders only: an effect may not read what it was not given.
bool ChunkLibrary::mayRead(const fs::path& path, const EffectAsset& effect) const {
    const fs::path real = realPath(path);
    return isInside(real, realPath(fs::path(effect.path).parent_path())) ||
           std::any_of(own_.begin(), own_.end(), [&](const fs::path& folder) { return isInside(real, folder); });
}

const SourceText* ChunkLibrary::readBeside(const std::string& name, const fs::path& folder) {
    std::error_code error;
    const fs::path path = (folder / (name + ".chunk")).lexically_normal();
    return fs::is_regular_file(path, error) ? readFile(path, name) : nullptr;
}

const SourceText* ChunkLibrary::readFile(const fs::path& path, const std::string& name) {
    auto& source = files_[nameOfSystem(path).string()];
    if (source) return source.get();
    const std::string text = readText(path, kMaxBytes);
    bytes_ += text.size();
    if (bytes_ > kMaxTotal)
        throw Error(SourceLoc{path.string()},
                    fmt::format("the chunks read so far have more than {} MB", kMaxTotal >> 20),
                    "includes grow without end, or the folders hold no shaders");
    source = readSource(text, name, path.string(), path.parent_path(), 1);
    return source.get();
}

/// realPath() of a file: its folder is looked up once.
fs::path ChunkLibrary::nameOfSystem(const fs::path& path) {
    std::error_code error;
    if (fs::is_symlink(path, error)) return realPath(path);
    const fs::path folder = path.parent_path();
    auto& real = realFolders_[folder.native()];
    if (real.empty()) real = realPath(folder);
    return real / path.filename();
}

const SourceText* ChunkLibrary::readProgram(const EffectAsset& effect, const std::string& name) {
    auto& source = programs_[{effect.path, name}];
    if (source) return source.get();
    const EffectProgram& program = effect.programs.find(name)->second;
    source = readSource(program.text, name, effect.path, fs::path(effect.path).parent_path(), program.firstLine);
    return source.get();
}

const FileIndex& ChunkLibrary::index() {
    if (!index_) index_.emplace(roots_.chunkFolders(), ".chunk");
    return *index_;
}

std::string_view includedName(std::string_view rest) {
    if (rest.size() < 3 || (rest[0] != '<' && rest[0] != '"')) return {};
    const auto end = rest.find(rest[0] == '<' ? '>' : '"', 1);
    if (end == std::string_view::npos) return {};
    std::string_view name = trimBlank(rest.substr(1, end - 1));
    if (name.ends_with(".chunk")) name.remove_suffix(6);
    return name;
}

}  // namespace crevice::cocos
