// One walk over the characters, with the depth of brackets and conditions.
#include "cocos/analysis/FunctionWalk.h"

#include <algorithm>
#include <array>
#include <utility>

#include "cocos/text/SourceText.h"

namespace crevice::cocos {
namespace {

/// True when the text is names and blanks alone, and each name is accepted.
template <class Accepts>
bool allWords(std::string_view text, Accepts accepts) {
    for (std::size_t at = 0; at < text.size();) {
        if (isBlank(text[at]) || text[at] == '\\') {
            ++at;
            continue;
        }
        const std::string_view word = leadingName(text.substr(at));
        if (word.empty() || !accepts(word)) return false;
        at += word.size();
    }
    return true;
}

/// Words that begin another thing than a function, or are none of its types.
bool isStorage(std::string_view word) {
    return word == "uniform" || word == "buffer" || word == "in" || word == "out" || word == "struct" ||
           word == "attribute" || word == "varying" || word == "shared" || word == "layout" || word == "return" ||
           word == "else";
}

bool mayBeType(std::string_view word) { return isNameStart(word.front()) && !isStorage(word); }

bool isQualifier(std::string_view word) {
    return word == "highp" || word == "mediump" || word == "lowp" || word == "precise" || word == "const" ||
           word == "invariant";
}

/// Characters that neither end a line nor open or close anything: most of a text.
constexpr std::array<bool, 256> kPlain = [] {
    std::array<bool, 256> plain{};
    plain.fill(true);
    for (const char c : {' ', '\t', '\n', '\r', '#', '{', '}', '(', ')', ';'})
        plain[static_cast<unsigned char>(c)] = false;
    return plain;
}();

bool isPlain(char c) { return kPlain[static_cast<unsigned char>(c)]; }

}  // namespace

std::size_t lineEnd(std::string_view text, std::size_t at) {
    std::size_t end = std::min(text.find('\n', at), text.size());
    while (end < text.size() && end > at && text[end - 1] == '\\')
        end = std::min(text.find('\n', end + 1), text.size());
    return end;
}

void addDefinesOf(std::string_view text, MacroBodies& macros) {
    for (std::size_t at = 0; at < text.size();) {
        while (at < text.size() && (text[at] == ' ' || text[at] == '\t')) ++at;
        const bool directive = at < text.size() && text[at] == '#';
        const std::size_t end = directive ? lineEnd(text, at) : std::min(text.find('\n', at), text.size());
        if (directive) {
            const Directive line = readDirective(text.substr(at, end - at));
            const std::string_view name = leadingName(line.rest);
            if (line.kind == LineKind::Define && !name.empty()) macros[name].push_back(line.rest.substr(name.size()));
        }
        at = end + 1;
    }
}

std::unordered_set<std::string_view> findFunctionMakers(const MacroBodies& defines) {
    const auto makes = [](std::string_view body) {
        std::size_t end = body.find_last_not_of(" \t\r\n\\");
        if (!body.starts_with('(') || end == std::string_view::npos || body[end] != '}') return false;
        int depth = 0;
        for (++end; end-- > 0;) {
            depth += int(body[end] == '}') - int(body[end] == '{');
            if (depth == 0) break;
        }
        const std::size_t before = end == 0 ? end : body.find_last_not_of(" \t\r\n\\", end - 1);
        return depth == 0 && before != std::string_view::npos && body[before] == ')' && before > body.find(')');
    };
    std::unordered_set<std::string_view> makers;
    for (const auto& [name, bodies] : defines)
        if (std::all_of(bodies.begin(), bodies.end(), makes)) makers.insert(name);
    return makers;
}

bool hasNever(std::string_view text) {
    for (std::size_t at = text.find('#'); at != std::string_view::npos; at = text.find('#', at + 1)) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const Directive line = readDirective(text.substr(at, end - at));
        if (isConditional(line.kind) && (line.rest == "0" || line.rest == "1")) return true;
    }
    return false;
}

std::string withoutNever(std::string_view text) {
    struct Branch {
        bool decided = false, never = false;
    };
    std::vector<Branch> open;
    std::string out(text);
    std::size_t nevers = 0;
    for (std::size_t at = 0, end; at < text.size(); at = end + 1) {
        end = lineEnd(text, at);
        const Directive line = readDirective(text.substr(at, end - at));
        if (line.kind == LineKind::If || line.kind == LineKind::Ifdef || line.kind == LineKind::Ifndef) {
            open.emplace_back();
        } else if (!isConditional(line.kind) || open.empty()) {
            if (line.kind == LineKind::Code) end = std::min(text.find('\n', at), text.size());
            for (std::size_t i = at; nevers > 0 && i < end; ++i)
                if (out[i] != '\n') out[i] = ' ';
            continue;
        }
        Branch& branch = open.back();
        nevers -= std::size_t(branch.never);
        if (line.kind == LineKind::Endif) {
            open.pop_back();
            continue;
        }
        const bool tested = line.kind == LineKind::If || line.kind == LineKind::Elif;
        branch.never = branch.decided || (tested && line.rest == "0");
        branch.decided = branch.decided || (tested && line.rest == "1");
        nevers += std::size_t(branch.never);
    }
    return out;
}

bool keepBrackets(const MacroBodies& macros) {
    return std::all_of(macros.begin(), macros.end(), [](const auto& macro) {
        int braces = 0, parens = 0;
        for (const std::string_view body : macro.second) {
            for (const char c : body) {
                braces += int(c == '{') - int(c == '}');
                parens += int(c == '(') - int(c == ')');
            }
        }
        return braces == 0 && parens == 0;
    });
}

bool FunctionWalk::run() {
    bool lineBegins = true;
    for (; at_ < text_.size(); ++at_) {
        const char c = text_[at_];
        if (isPlain(c)) {
            while (at_ + 1 < text_.size() && isPlain(text_[at_ + 1])) ++at_;
            last_ = text_[at_];
            ended_ = lineBegins = false;
            continue;
        }
        if (c == '\n') lineBegins = true;
        if (isBlank(c)) continue;
        if (c == '#' && lineBegins ? !takeDirective() : !take(c)) return false;
        lineBegins = false;
    }
    return depth_ == Depth{} && branches_.empty();
}

bool FunctionWalk::take(char c) {
    const bool nothing = std::exchange(ended_, false);
    if (c == '{') {
        if (depth_.paren > 0 && depth_.brace == 0) return false;
        if (depth_.brace == 0) isBody_ = last_ == ')' && isHead();
        if (depth_.brace++ == 0 && last_ == ')') begin();
    } else if (c == '}') {
        if (--depth_.brace < 0) return false;
        if (depth_.brace == 0 && isOpen_) end(at_ + 1);
        if (depth_.brace == 0 && isBody_) ended_ = true;
        if (depth_.brace == 0) finishStatement();
    } else if (c == '(' && depth_.brace == 0) {
        if (depth_.paren++ == 0) {
            paren_ = at_;
            definesInList_ = false;
        }
    } else if (c == ')' && depth_.brace == 0) {
        if (--depth_.paren < 0) return false;
    } else if (c == ';' && depth_ == Depth{}) {
        if (nothing || (last_ == ')' && makers_.contains(nameBefore(text_, paren_)))) emptyStatements.push_back(at_);
        ended_ = true;
        finishStatement();
    }
    last_ = c;
    return true;
}

void FunctionWalk::finishStatement() {
    statementBegin_ = at_ + 1;
    if (branches_.size() < unfinishedIn_ || unfinishedIn_ == 0) unfinished_ = false;
}

/// True for the list at `paren_` when a name that is no macro and a type stand in front of it, in whatever branch.
bool FunctionWalk::isHead() const {
    const std::string_view name = nameBefore(text_, paren_);
    if (name.empty() || macros_.contains(name)) return false;
    const std::string_view type = nameBefore(text_, offsetOf(name));
    if (type.empty() || isStorage(type)) return false;
    if (offsetOf(type) >= directiveEnd_) return true;
    const std::size_t line = text_.rfind('\n', offsetOf(type)) + 1;  // npos + 1 is 0.
    return readDirective(text_.substr(line, offsetOf(name) - line)).kind == LineKind::Code;
}

/// A body begins whose list did at `paren_`. Of what is not understood nothing is said.
void FunctionWalk::begin() {
    if (isOpen_) return;  // Another head of it, in another branch.
    const std::string_view name = nameBefore(text_, paren_);
    const std::string_view type = name.empty() ? name : nameBefore(text_, offsetOf(name));
    if (type.empty() || offsetOf(type) < directiveEnd_) return;
    const std::string_view before = text_.substr(statementBegin_, offsetOf(type) - statementBegin_);
    if (unfinished_ || definesInList_ || macros_.contains(name) || isStorage(name) ||
        !standsFor(mayBeType, types_, type, 0) ||
        !allWords(before, [this](std::string_view word) { return standsFor(isQualifier, qualifiers_, word, 0); }))
        return;
    std::size_t start = statementBegin_;
    while (isBlank(text_[start])) ++start;
    functions.push_back({name, start, start});
    branchesAtBegin_ = branches_.size();
    isOpen_ = true;
}

/// True when a word is accepted or stands for accepted words alone. Each macro is read once at each depth: bodies of
/// many words that name each other would be read again for every word.
bool FunctionWalk::standsFor(Accepts accepts, Answers& answers, std::string_view word, std::size_t depth) {
    const auto macro = macros_.find(word);
    if (macro == macros_.end()) return accepts(word);
    if (depth == answers.size()) return false;
    const auto [answer, isNew] = answers[depth].try_emplace(macro->first, false);
    if (!isNew) return answer->second;
    const bool all = std::all_of(macro->second.begin(), macro->second.end(), [&](std::string_view body) {
        return allWords(body, [&](std::string_view part) { return standsFor(accepts, answers, part, depth + 1); });
    });
    return answer->second = all;
}

/// A body ends. What ends in a branch goes on in the others: it is whole at their #endif.
void FunctionWalk::end(std::size_t at) {
    if (branches_.size() > branchesAtBegin_) {
        functions.back().stays = true;
        return;
    }
    functions.back().end = at;
    isOpen_ = false;
    ended_ = true;
}

bool FunctionWalk::takeDirective() {
    const std::size_t begin = at_, end = lineEnd(text_, at_);
    at_ = end - 1;
    ended_ = false;
    const LineKind kind = readDirective(text_.substr(begin, end - begin)).kind;
    if (depth_ == Depth{}) {
        noteUnfinished(begin, kind == LineKind::Elif || kind == LineKind::Else || kind == LineKind::Endif);
        directiveEnd_ = statementBegin_ = end;
    }
    const bool defines = kind == LineKind::Define || kind == LineKind::Undef;
    if (isOpen_ && defines) functions.back().stays = true;
    if (depth_.paren > 0 && defines) definesInList_ = true;
    if (!isConditional(kind)) return true;
    if (kind == LineKind::If || kind == LineKind::Ifdef || kind == LineKind::Ifndef) {
        branches_.push_back(depth_);
        return true;
    }
    if (branches_.empty()) return false;
    if (isOpen_ && (!(branches_.back() == depth_) || branches_.size() <= branchesAtBegin_))
        functions.back().stays = true;
    if (kind != LineKind::Endif) {
        depth_ = branches_.back();
        return true;
    }
    branches_.pop_back();
    branchesAtBegin_ = std::min(branchesAtBegin_, branches_.size());
    if (isOpen_ && depth_.brace == 0 && branches_.size() == branchesAtBegin_) this->end(end);
    return true;
}

/// What a branch leaves open goes on behind the whole condition.
void FunctionWalk::noteUnfinished(std::size_t directive, bool turns) {
    const std::string_view open = text_.substr(statementBegin_, directive - statementBegin_);
    if (std::all_of(open.begin(), open.end(), isBlank)) return;
    unfinishedIn_ = turns ? branches_.size() : 0;
    unfinished_ = true;
}

}  // namespace crevice::cocos
