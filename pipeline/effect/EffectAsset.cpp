// Splits a .effect file into its CCEffect header and its CCProgram texts.
#include "effect/EffectAsset.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "effect/EffectHeader.h"

namespace crevice {
namespace {

bool isNamePart(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-'; }

/// Walks the file's top level: comments, `CCEffect %{ … }%`, `CCProgram NAME %{ … }%`, nothing else.
class BlockScanner {
public:
    BlockScanner(std::string_view text, EffectAsset& effect, EffectReading reading, Problems& problems)
        : text_(text), effect_(effect), reading_(reading), problems_(problems) {
        if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
    }

    void run() {
        while (skipBlank()) {
            const std::size_t start = at_;
            const std::string word = readName();
            if (word == "CCEffect") {
                readEffect(start);
            } else if (word == "CCProgram") {
                readProgram(start);
            } else {
                if (word.empty()) ++at_;
                if (reading_ == EffectReading::Tolerant) {
                    skipStray(start);
                    continue;
                }
                problems_.error(placeOf(start, std::max<std::size_t>(1, word.size())), "text outside of the blocks",
                                "only 'CCEffect %{ … }%' and 'CCProgram NAME %{ … }%' and comments stand here");
                return;
            }
            if (stopped_) return;
        }
        if (!hasEffect_)
            problems_.error({effect_.path, 1, 1, 1}, "the file has no CCEffect block",
                            "begin it with: CCEffect %{ techniques: … }%");
    }

private:
    /// Moves over white space and comments. False at the end of the file.
    bool skipBlank() {
        while (at_ < text_.size()) {
            if (std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
                ++at_;
            } else if (text_.substr(at_, 2) == "//") {
                at_ = std::min(text_.find('\n', at_), text_.size());
            } else if (text_.substr(at_, 2) == "/*") {
                const auto end = text_.find("*/", at_ + 2);
                at_ = end == std::string_view::npos ? text_.size() : end + 2;
            } else {
                return true;
            }
        }
        return false;
    }

    /// Cocos reads the blocks and nothing else.
    void skipStray(std::size_t start) {
        at_ =
            std::min({text_.find('\n', at_), text_.find("CCProgram", at_), text_.find("CCEffect", at_), text_.size()});
        problems_.verbose(placeOf(start, 1), "text outside of the blocks is not read");
    }

    std::string readName() {
        const std::size_t start = at_;
        while (at_ < text_.size() && isNamePart(text_[at_])) ++at_;
        return std::string(text_.substr(start, at_ - start));
    }

    SourceLoc placeOf(std::size_t offset, std::size_t length) const {
        const std::string_view before = text_.substr(0, offset);
        const auto line = static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1;
        const auto lineStart = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
        return {effect_.path, line, static_cast<int>(offset - lineStart) + 1, static_cast<int>(length)};
    }

    /// The text between `%{` and the first `}%`, and its first line.
    bool readBody(std::size_t start, const std::string& what, EffectProgram& body) {
        skipBlank();
        if (text_.substr(at_, 2) != "%{") {
            problems_.error(placeOf(start, what.size()), fmt::format("'{}' is not followed by '%{{'", what),
                            "begin a block with %{ and end it with }%");
            stopped_ = true;
            return false;
        }
        const std::size_t begin = at_ + 2;
        const auto end = text_.find("}%", begin);
        // Neither GLSL nor YAML has `%{`: before the end it begins the next block.
        const bool open = reading_ == EffectReading::Strict ? text_.find("%{", begin) < end : holdsBlock(begin, end);
        if (end == std::string_view::npos || open) {
            problems_.error(placeOf(start, what.size()), fmt::format("the block '{}' is not closed", what),
                            "end it with }%");
            stopped_ = true;
            return false;
        }
        body.text = text_.substr(begin, end - begin);
        body.firstLine = placeOf(begin, 1).line;
        at_ = end + 2;
        return true;
    }

    /// The beginning of a block within another: that one's end is missing.
    bool holdsBlock(std::size_t begin, std::size_t end) const {
        const std::string_view body = text_.substr(begin, end == std::string_view::npos ? end : end - begin);
        for (std::size_t at = body.find("%{"); at != std::string_view::npos; at = body.find("%{", at + 2)) {
            const std::string_view line = body.substr(body.rfind('\n', at) + 1);
            const auto word = std::min(line.find_first_not_of(" \t"), line.size());
            if (line.substr(word).starts_with("CCProgram") || line.substr(word).starts_with("CCEffect")) return true;
        }
        return false;
    }

    /// YAML indents by spaces: how wide a tab is, nobody can know.
    bool checkIndentation(const EffectProgram& body) {
        std::size_t begin = 0;
        for (int line = body.firstLine; begin < body.text.size(); ++line) {
            const std::size_t end = std::min(body.text.find('\n', begin), body.text.size());
            const std::size_t word = body.text.find_first_not_of(" \t\r", begin);
            const std::size_t tab = body.text.find('\t', begin);
            if (tab < word && word < end && body.text[word] != '#') {
                problems_.error({effect_.path, line, static_cast<int>(tab - begin) + 1, 1},
                                "a tab stands in the indentation", "indent by spaces");
                return false;
            }
            begin = end + 1;
        }
        return true;
    }

    void readEffect(std::size_t start) {
        const SourceLoc where = placeOf(start, 8);
        EffectProgram body;
        if (!readBody(start, "CCEffect", body)) return;
        if (hasEffect_) {
            problems_.error(where, "a second CCEffect block", "one file is one effect; add a technique instead",
                            {{effect_.where, "the first one"}});
            return;
        }
        hasEffect_ = true;
        effect_.where = where;
        if (reading_ == EffectReading::Tolerant) std::replace(body.text.begin(), body.text.end(), '\t', ' ');
        if (!checkIndentation(body)) return;
        try {
            readEffectHeader(parseYaml(body.text, effect_.path, body.firstLine), effect_, reading_, problems_);
        } catch (const Error& error) {
            problems_.add(error);
        }
    }

    void readProgram(std::size_t start) {
        skipBlank();
        const std::size_t nameStart = at_;
        const std::string name = readName();
        EffectProgram body;
        if (name.empty()) {
            problems_.error(placeOf(start, 9), "a CCProgram has no name", "CCProgram my-fs %{ … }%");
            stopped_ = true;
            return;
        }
        if (!readBody(start, "CCProgram " + name, body)) return;
        if (const auto it = effect_.programs.find(name); it != effect_.programs.end()) {
            if (reading_ == EffectReading::Tolerant) {
                problems_.warning(placeOf(nameStart, name.size()),
                                  fmt::format("two programs are named '{}': the last one holds", name));
                it->second = std::move(body);
                return;
            }
            problems_.error(placeOf(nameStart, name.size()), fmt::format("two programs are named '{}'", name),
                            "rename one of them", {{{effect_.path, it->second.firstLine, 0, 1}, "the first one"}});
            return;
        }
        effect_.programs.emplace(name, std::move(body));
    }

    std::string_view text_;
    EffectAsset& effect_;
    EffectReading reading_;
    Problems& problems_;
    std::size_t at_ = 0;
    bool hasEffect_ = false;
    bool stopped_ = false;
};

}  // namespace

EffectAsset parseEffect(std::string_view text, const std::string& name, const std::string& path, Problems& problems,
                        EffectReading reading) {
    EffectAsset effect;
    effect.name = name;
    effect.path = path;
    BlockScanner(text, effect, reading, problems).run();
    return effect;
}

}  // namespace crevice
