// Puts a shader stage together from programs and chunks, line by line.
#include "effect/Includes.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/Text.h"
#include "effect/GlslText.h"

namespace crevice {
namespace {

namespace fs = std::filesystem;

std::string_view trim(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Without the blanks behind a backslash at the end, those of Windows' line ends too: the line goes on all the same, as
/// in C.
std::string_view continued(std::string_view line) {
    const std::size_t last = line.find_last_not_of(" \t\v\f");
    return last != std::string_view::npos && line[last] == '\\' ? line.substr(0, last + 1) : line;
}

/// Splits "#  word rest"; empty word when the line is no directive.
struct Directive {
    std::string_view word, rest;
};
Directive parseDirective(std::string_view line) {
    line = trim(line);
    if (line.empty() || line.front() != '#') return {};
    line = trim(line.substr(1));
    const auto end = std::min(line.find_first_of(" \t<\"("), line.size());
    return {line.substr(0, end), trim(line.substr(end))};
}

bool isInside(const fs::path& path, const fs::path& folder) {
    std::error_code error;
    const fs::path relative =
        fs::relative(fs::weakly_canonical(path, error), fs::weakly_canonical(folder, error), error);
    return !error && !relative.empty() && *relative.begin() != "..";
}

/// A text to be flattened: who it is, where it is written.
struct Chunk {
    std::string key;    ///< Identity for include-once and cycles.
    std::string shown;  ///< Name in chains.
    std::string file;
    std::string text;  ///< Empty while it is only in the file.
    bool inFile = false;
    int firstLine = 1;
    fs::path folder;  ///< Base of "./" includes; empty for generated chunks.
};

class Flattener {
public:
    Flattener(const IncludeSources& sources, Problems& problems) : sources_(sources), problems_(problems) {}

    FlatSource run(const std::string& program, const SourceLoc& where) {
        if (auto chunk = find(program, effectFolder(), where, "program")) emit(*chunk, where);
        return std::move(out_);
    }

private:
    fs::path effectFolder() const { return fs::path(sources_.effect.path).parent_path(); }

    std::optional<Chunk> find(const std::string& name, const fs::path& folder, const SourceLoc& where,
                              const char* what) {
        if (const auto it = sources_.effect.programs.find(name); it != sources_.effect.programs.end()) {
            const std::string& path = sources_.effect.path;
            return Chunk{"program " + name, name, path, it->second.text, false, it->second.firstLine, effectFolder()};
        }
        if (name.starts_with('.')) return findRelative(name, folder, where);
        if (const auto it = sources_.generated.find(name); it != sources_.generated.end())
            return Chunk{"generated " + name, name, "<generated " + name + ">", it->second, false, 1, {}};
        if (const auto path = sources_.roots.find(AssetKind::Chunk, name)) return fileChunk(*path, name);
        reportMissing(name, where, what);
        return std::nullopt;
    }

    std::optional<Chunk> findRelative(const std::string& name, const fs::path& folder, const SourceLoc& where) {
        fs::path path = (folder / name).lexically_normal();
        if (path.extension() != ".chunk") path += ".chunk";
        if (!isInside(path, effectFolder()) && !sources_.roots.contains(path)) {
            problems_.error(where, fmt::format("include '{}' leaves the asset folders", name),
                            "chunks are read below the effect's own folder and the asset roots only");
            return std::nullopt;
        }
        std::error_code error;
        if (fs::is_regular_file(path, error)) return fileChunk(path, name);
        problems_.error(where, fmt::format("no chunk '{}'", name), fmt::format("looked for {}", path.string()));
        return std::nullopt;
    }

    Chunk fileChunk(const fs::path& path, const std::string& name) {
        std::error_code error;
        const fs::path real = fs::weakly_canonical(path, error);
        return {"file " + (error ? path : real).string(), name, path.string(), {}, true, 1, path.parent_path()};
    }

    void reportMissing(const std::string& name, const SourceLoc& where, const char* what) {
        std::vector<std::string> known = sources_.roots.list(AssetKind::Chunk);
        for (const auto& [program, text] : sources_.effect.programs) known.push_back(program);
        for (const auto& [chunk, text] : sources_.generated) known.push_back(chunk);
        std::string help;
        if (const auto near = nearestNames(name, known); !near.empty()) {
            for (const std::string& word : near) help += (help.empty() ? "did you mean '" : ", '") + word + "'";
            help += "? ";
        }
        help += fmt::format("looked for: CCProgram {} in {}", name, sources_.effect.path);
        for (const fs::path& root : sources_.roots.roots())
            help += fmt::format(", {}", (root / "effects" / "chunks" / (name + ".chunk")).string());
        const bool program = std::string_view(what) == "program";
        const std::string message =
            program ? fmt::format("no program '{}'", name) : fmt::format("no chunk or program '{}' to include", name);
        problems_.error(where, message, help);
    }

    void emit(const Chunk& chunk, const SourceLoc& where) {
        stack_.push_back({chunk.key, chunk.shown});
        const std::uint32_t file = fileIndex(chunk.file);
        std::string text = blankComments(chunk.inFile ? readText(chunk.file, sources_.limits.maxBytes) : chunk.text);
        if (text.starts_with("\xEF\xBB\xBF")) text.replace(0, 3, "   ");
        bytes_ += text.size();
        int line = chunk.firstLine;
        for (std::size_t at = 0; at < text.size() && !stopped_; ++line) {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            emitLine(continued(std::string_view(text).substr(at, end - at)), {file, line}, chunk);
            at = end + 1;
        }
        stack_.pop_back();
        if (!stopped_ && bytes_ > sources_.limits.maxBytes) stop(where, "the flattened shader is larger than 16 MB");
    }

    void emitLine(std::string_view line, FlatSource::Origin origin, const Chunk& chunk) {
        const Directive directive = parseDirective(line);
        if (directive.word == "include") {
            include(line, directive.rest, origin, chunk);
            return;
        }
        if (directive.word == "if" || directive.word == "ifdef" || directive.word == "ifndef") ++conditions_;
        if (directive.word == "endif") --conditions_;
        if (directive.word == "version") {
            problems_.error(place(line, origin), "a program must not have '#version'",
                            "remove the line: every stage is compiled as version 450");
            line = {};
        }
        if (directive.word == "line") line = {};  // It would spoil the places of messages.
        push(line, origin);
    }

    void include(std::string_view line, std::string_view argument, FlatSource::Origin origin, const Chunk& chunk) {
        const SourceLoc where = place(line, origin);
        const char close = argument.empty() ? '\0' : argument.front() == '<' ? '>' : argument.front();
        const auto end = argument.size() < 3 ? std::string_view::npos : argument.find(close, 1);
        if ((close != '>' && close != '"') || end == std::string_view::npos || end == 1) {
            problems_.error(where, "malformed #include", "write #include <chunk-name>");
            return push({}, origin);
        }
        const std::string name(argument.substr(1, end - 1));
        if (++includes_ > sources_.limits.maxIncludes) return stop(where, "a shader has more than 1000 includes");
        if (stack_.size() >= sources_.limits.maxDepth) return stop(where, "includes are nested deeper than 64");
        const auto target = find(name, chunk.folder, where, "include");
        if (!target) return push({}, origin);
        if (reportCycle(*target, where)) return push({}, origin);
        emitOnce(*target, where, origin);
    }

    /// First include: the text. Later: nothing, or guarded text if the first may be in a branch that is not taken.
    void emitOnce(const Chunk& target, const SourceLoc& where, FlatSource::Origin origin) {
        const auto seen = seen_.find(target.key);
        if (seen != seen_.end() && !seen->second.conditional) return push({}, origin);
        const Seen info = seen != seen_.end() ? seen->second : Seen{conditions_ > 0, seen_.size()};
        seen_.emplace(target.key, info);
        const std::string guard = fmt::format("CREVICE_INCLUDED_{}", info.number);
        if (info.conditional) {
            push("#ifndef " + guard, origin);
            push("#define " + guard, origin);
        } else {
            push({}, origin);
        }
        emit(target, where);
        if (info.conditional) push("#endif", origin);
    }

    bool reportCycle(const Chunk& target, const SourceLoc& where) {
        const auto first =
            std::find_if(stack_.begin(), stack_.end(), [&](const auto& entry) { return entry.first == target.key; });
        if (first == stack_.end()) return false;
        std::string chain;
        for (auto it = first; it != stack_.end(); ++it) chain += it->second + " -> ";
        problems_.error(where, fmt::format("include cycle: {}{}", chain, target.shown),
                        "move what both need into a third chunk");
        return true;
    }

    void stop(const SourceLoc& where, const char* message) {
        stopped_ = true;
        problems_.error(where, message, "includes grow without end, or the shader should be split");
    }

    void push(std::string_view line, FlatSource::Origin origin) {
        out_.text.append(line).push_back('\n');
        out_.lines.push_back(origin);
    }

    SourceLoc place(std::string_view line, FlatSource::Origin origin) const {
        const auto hash = line.find('#');
        const auto length = trim(line).size();
        return {out_.files[origin.file], origin.line, static_cast<int>(hash) + 1, static_cast<int>(length)};
    }

    std::uint32_t fileIndex(const std::string& file) {
        const auto index =
            static_cast<std::size_t>(std::find(out_.files.begin(), out_.files.end(), file) - out_.files.begin());
        if (index == out_.files.size()) out_.files.push_back(file);
        return static_cast<std::uint32_t>(index);
    }

    struct Seen {
        bool conditional = false;
        std::size_t number = 0;
    };
    const IncludeSources& sources_;
    Problems& problems_;
    FlatSource out_;
    std::map<std::string, Seen> seen_;
    std::vector<std::pair<std::string, std::string>> stack_;  ///< Key and shown name of the texts being emitted.
    std::size_t includes_ = 0, bytes_ = 0;
    int conditions_ = 0;  ///< Nesting of #if around the present line.
    bool stopped_ = false;
};

}  // namespace

SourceLoc FlatSource::locate(int line, int column, int length) const {
    if (lines.empty()) return {};
    const auto index = static_cast<std::size_t>(std::clamp(line, 1, static_cast<int>(lines.size())) - 1);
    return {files[lines[index].file], lines[index].line, column, length};
}

FlatSource flattenProgram(const IncludeSources& sources, const std::string& program, const SourceLoc& where,
                          Problems& problems) {
    return Flattener(sources, problems).run(program, where);
}

}  // namespace crevice
