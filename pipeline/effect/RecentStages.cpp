// A short list; texts, and what of their heads concerns them, are told apart by a hash.
#include "effect/RecentStages.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <unordered_map>

#include "core/Files.h"
#include "effect/SpirvCheck.h"

namespace crevice {
namespace {

constexpr std::size_t kMostStages = 256;  ///< Of 20 to 100 KB each.
constexpr std::string_view kDefine = "#define ";

constexpr std::array<bool, 256> kNameParts = [] {
    std::array<bool, 256> parts{};
    for (unsigned c = '0'; c <= '9'; ++c) parts[c] = true;
    for (unsigned c = 'a'; c <= 'z'; ++c) parts[c] = parts[c - 'a' + 'A'] = true;
    parts['_'] = true;
    return parts;
}();

bool isNamePart(char c) { return kNameParts[static_cast<unsigned char>(c)]; }

/// The name that a line defines, with a value and no parameters; else nothing.
std::string_view definedName(std::string_view line) {
    if (!line.starts_with(kDefine)) return {};
    line.remove_prefix(kDefine.size());
    const auto end = std::find_if_not(line.begin(), line.end(), isNamePart);
    return end != line.end() && *end == ' ' ? std::string_view(line.begin(), end) : std::string_view();
}

/// Names, and which of them stand in texts.
class NamedWords {
public:
    void watch(std::string_view name) {
        named_.emplace(name, false);
        lengths_[static_cast<unsigned char>(name.front())] |= 1ull << (name.size() & 63u);
    }

    void read(std::string_view text) {
        for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
            for (end = at; end < text.size() && isNamePart(text[end]);) ++end;
            // Most words are passed over by one look.
            if (end == at || (lengths_[static_cast<unsigned char>(text[at])] >> ((end - at) & 63u) & 1u) == 0) continue;
            if (const auto it = named_.find(text.substr(at, end - at)); it != named_.end()) it->second = true;
        }
    }

    bool isNamed(std::string_view name) const { return named_.find(name)->second; }

private:
    std::unordered_map<std::string_view, bool> named_;
    std::array<std::uint64_t, 256> lengths_{};  ///< Of names, by their first character.
};

/// A name, or `##`, that goes on behind the end of a line: words as read() finds them would be parts of it.
bool isSplicedWithin(std::string_view text) {
    const auto mayGoOn = [](char c) { return isNamePart(c) || c == '#' || c == '\\'; };
    for (auto at = text.find('\\'); at != std::string_view::npos; at = text.find('\\', at + 1)) {
        std::size_t next = at + 1;
        if (next < text.size() && text[next] == '\r') ++next;
        if (next + 1 >= text.size() || text[next] != '\n') continue;
        if (at > 0 && mayGoOn(text[at - 1]) && mayGoOn(text[next + 1])) return true;
    }
    return false;
}

/// The head without definitions of what nothing in the stage names: they are the other stage's, and with other values
/// of them this one stays what it is. All of it where the text puts names together, or
/// breaks them.
std::string usedHead(const StageSource& source) {
    if (source.text.find("##") != std::string::npos || source.head.find('\\') != std::string::npos ||
        isSplicedWithin(source.text))
        return source.head;
    std::vector<std::string_view> lines;
    for (std::string_view rest = source.head; !rest.empty(); rest.remove_prefix(lines.back().size()))
        lines.push_back(rest.substr(0, std::min(rest.find('\n'), rest.size() - 1) + 1));
    NamedWords words;
    for (const std::string_view line : lines)
        if (const std::string_view name = definedName(line); !name.empty()) words.watch(name);
    words.read(source.text);
    for (const std::string_view line : lines) {
        const std::string_view name = definedName(line);
        words.read(line.substr(name.empty() ? 0 : kDefine.size() + name.size()));
    }
    std::string used;
    for (const std::string_view line : lines) {
        const std::string_view name = definedName(line);
        if (name.empty() || words.isNamed(name)) used += line;
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
