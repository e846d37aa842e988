// A short list; texts, and what of their heads concerns them, are told apart by a hash.
#include "effect/RecentStages.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <unordered_set>

#include "core/Files.h"
#include "effect/SpirvCheck.h"

namespace crevice {
namespace {

constexpr std::size_t kMostStages = 256;  ///< Of 20 to 100 KB each.
constexpr std::string_view kDefine = "#define ";

bool isNamePart(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

void addWords(std::string_view text, std::unordered_set<std::string_view>& words) {
    for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
        for (end = at; end < text.size() && isNamePart(text[end]);) ++end;
        if (end > at) words.insert(text.substr(at, end - at));
    }
}

/// The name that a line defines, with a value and no parameters; else nothing.
std::string_view definedName(std::string_view line) {
    if (!line.starts_with(kDefine)) return {};
    line.remove_prefix(kDefine.size());
    const auto end = std::find_if_not(line.begin(), line.end(), isNamePart);
    return end != line.end() && *end == ' ' ? std::string_view(line.begin(), end) : std::string_view();
}

/// The head without definitions of what nothing in the stage names: they are the other stage's, and with other values
/// of them this one stays what it is. All of it where the text puts names together.
std::string usedHead(const StageSource& source) {
    if (source.text.find("##") != std::string::npos || source.head.find('\\') != std::string::npos) return source.head;
    std::vector<std::string_view> lines;
    for (std::string_view rest = source.head; !rest.empty(); rest.remove_prefix(lines.back().size()))
        lines.push_back(rest.substr(0, std::min(rest.find('\n'), rest.size() - 1) + 1));
    std::unordered_set<std::string_view> words;
    addWords(source.text, words);
    for (const std::string_view line : lines) {
        const std::string_view name = definedName(line);
        addWords(line.substr(name.empty() ? 0 : kDefine.size() + name.size()), words);
    }
    std::string used;
    for (const std::string_view line : lines) {
        const std::string_view name = definedName(line);
        if (name.empty() || words.contains(name)) used += line;
    }
    return used;
}

bool areSame(const std::vector<FlatSource::Origin>& a, const std::vector<FlatSource::Origin>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& left, const auto& right) {
        return left.file == right.file && left.line == right.line;
    });
}

}  // namespace

RecentStages::Kept* RecentStages::find(const StageSource& source, ShaderCompiler& compiler, Problems& problems) {
    const std::string key =
        contentHash(fmt::format("{}\n{}{}", static_cast<int>(source.stage), usedHead(source), source.text));
    const auto known = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) { return kept.key == key; });
    if (known != kept_.end()) return &*known;
    auto fresh = compiler.compile({&source, 1}, {}, problems);
    if (fresh.empty()) return nullptr;
    kept_.push_front({key, {std::move(fresh.front()), nullptr}, false, {}, {}});
    if (kept_.size() > kMostStages) kept_.pop_back();
    return &kept_.front();
}

std::optional<RecentStages::Stage> RecentStages::get(const StageSource& source, bool check, ShaderCompiler& compiler,
                                                     Problems& problems) {
    Kept* kept = find(source, compiler, problems);
    if (kept == nullptr) return std::nullopt;
    if (check && !kept->checked) checkSpirv(kept->stage.code, source, problems);
    kept->checked = kept->checked || (check && !problems.hasErrors());
    if (problems.hasErrors()) return std::nullopt;
    if (!kept->stage.facts || kept->files != source.flat.files || !areSame(kept->lines, source.flat.lines)) {
        kept->stage.facts = std::make_shared<StageFacts>(reflectStage(kept->stage.code, source));
        kept->files = source.flat.files;
        kept->lines = source.flat.lines;
    }
    return kept->stage;
}

}  // namespace crevice
