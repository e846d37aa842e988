// One walk finds the functions, a second one who calls whom; names are enough, as for Cocos' compiler.
#include "cocos/LiveFunctions.h"

#include <algorithm>
#include <array>

#include "cocos/SourceText.h"

namespace crevice::cocos {
namespace {

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// The name that ends in front of `at`, over blanks.
std::string_view nameBefore(std::string_view text, std::size_t at) {
    while (at > 0 && isBlank(text[at - 1])) --at;
    std::size_t begin = at;
    while (begin > 0 && isNamePart(text[begin - 1])) --begin;
    return text.substr(begin, at - begin);
}

/// Behind the preprocessor line that begins at `at`, with its continuations; its newline is left.
std::size_t lineEnd(std::string_view text, std::size_t at) {
    std::size_t end = std::min(text.find('\n', at), text.size());
    while (end < text.size() && end > at && text[end - 1] == '\\')
        end = std::min(text.find('\n', end + 1), text.size());
    return end;
}

/// Finds definitions of functions: a list in parentheses and then a body, outside of all braces.
class FunctionWalk {
public:
    explicit FunctionWalk(std::string_view text) : text_(text) {}

    /// False when conditions and braces cross.
    bool run() {
        bool lineBegins = true;
        for (; at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            if (c == '\n') lineBegins = true;
            if (isBlank(c)) continue;
            if (c == '#' && lineBegins ? !takeDirective() : !take(c)) return false;
            lineBegins = false;
        }
        return depth_.brace == 0 && depth_.paren == 0 && branches_.empty();
    }

    std::vector<FunctionRange> functions;

private:
    struct Depth {
        int brace = 0, paren = 0;
        bool operator==(const Depth&) const = default;
    };

    bool take(char c) {
        if (c == '{') {
            if (depth_.brace++ == 0 && last_ == ')' && !begin()) return false;
        } else if (c == '}') {
            if (--depth_.brace < 0) return false;
            if (depth_.brace == 0 && isOpen_ && !end()) return false;
        } else if (c == '(' && depth_.brace == 0) {
            if (depth_.paren++ == 0) paren_ = at_;
        } else if (c == ')' && depth_.brace == 0) {
            if (--depth_.paren < 0) return false;
        }
        last_ = c;
        return true;
    }

    /// The body of a function begins; its list did at `paren_`.
    bool begin() {
        const std::string_view name = nameBefore(text_, paren_);
        const std::string_view type = name.empty() ? name : nameBefore(text_, offsetOf(name));
        if (type.empty()) return true;
        const std::string_view before = nameBefore(text_, offsetOf(type));
        const bool precise = before == "highp" || before == "mediump" || before == "lowp";
        const std::size_t start = offsetOf(precise && offsetOf(before) >= directiveEnd_ ? before : type);
        if (start < directiveEnd_) return false;
        functions.push_back({name, start, start});
        branchesAtBegin_ = branches_.size();
        return isOpen_ = true;
    }

    bool end() {
        if (branches_.size() != branchesAtBegin_) return false;
        functions.back().end = at_ + 1;
        isOpen_ = false;
        return true;
    }

    bool takeDirective() {
        const std::size_t begin = at_, end = lineEnd(text_, at_);
        at_ = end - 1;
        if (depth_ == Depth{}) directiveEnd_ = end;
        const LineKind kind = readDirective(text_.substr(begin, end - begin)).kind;
        if (isOpen_ && (kind == LineKind::Define || kind == LineKind::Undef)) functions.back().defines = true;
        if (!isConditional(kind)) return true;
        if (kind == LineKind::If || kind == LineKind::Ifdef || kind == LineKind::Ifndef) {
            branches_.push_back(depth_);
            return true;
        }
        if (branches_.empty() || !(branches_.back() == depth_)) return false;
        if (isOpen_ && branches_.size() <= branchesAtBegin_) return false;
        if (kind == LineKind::Endif) branches_.pop_back();
        return true;
    }

    std::size_t offsetOf(std::string_view part) const { return static_cast<std::size_t>(part.data() - text_.data()); }

    std::string_view text_;
    std::size_t at_ = 0, paren_ = 0;
    std::size_t directiveEnd_ = 0;  ///< Of the last preprocessor line outside of braces and parentheses.
    Depth depth_;
    std::vector<Depth> branches_;  ///< Depths at the #if of each enclosing condition.
    std::size_t branchesAtBegin_ = 0;
    char last_ = '\0';
    bool isOpen_ = false;
};

/// Functions and macros by name, and which names stand in each.
class CallGraph {
public:
    CallGraph(std::string_view text, const std::vector<FunctionRange>& functions, const MacroBodies& macros) {
        for (const FunctionRange& function : functions) addNode(function.name);
        functionCount_ = nodes_.size();
        for (const auto& [name, bodies] : macros) addNode(name);
        for (const auto& [name, bodies] : macros) {
            Node& macro = nodes_[index_[name]];
            for (const std::string_view body : bodies) {
                macro.pastes = macro.pastes || body.find("##") != std::string::npos;
                collectNames(body, macro.names);
            }
        }
        std::size_t at = 0;
        for (const FunctionRange& function : functions) {
            readOutside(text.substr(at, function.begin - at));
            collectNames(text.substr(function.begin, function.end - function.begin),
                         nodes_[index_[function.name]].names);
            if (function.defines) outside_.push_back(index_[function.name]);
            at = function.end;
        }
        readOutside(text.substr(at));
    }

    /// What the function leads to, and what stands outside of functions, is alive. False when there is no such
    /// function, or when a macro that pastes names is alive: any name may be meant.
    bool follow(std::string_view function) {
        const auto entry = index_.find(function);
        if (entry == index_.end() || entry->second >= functionCount_) return false;
        std::vector<std::size_t> waiting = outside_;
        waiting.push_back(entry->second);
        while (!waiting.empty()) {
            Node& next = nodes_[waiting.back()];
            waiting.pop_back();
            if (next.live) continue;
            if (next.pastes) return false;
            next.live = true;
            waiting.insert(waiting.end(), next.names.begin(), next.names.end());
        }
        return true;
    }

    bool isLive(std::string_view function) const { return nodes_[index_.find(function)->second].live; }

private:
    struct Node {
        std::vector<std::size_t> names;
        bool live = false, pastes = false;
    };

    void addNode(std::string_view name) {
        if (index_.try_emplace(name, nodes_.size()).second) nodes_.emplace_back();
        firstLetters_[static_cast<unsigned char>(name.front()) & 127u] = true;
    }

    /// The known names of a text; its preprocessor lines are left out: what macros stand for is known.
    void collectNames(std::string_view text, std::vector<std::size_t>& names, bool lineBegins = false) const {
        for (std::size_t at = 0; at < text.size();) {
            const char c = text[at];
            if (c == '#' && lineBegins) {
                at = lineEnd(text, at);
                continue;
            }
            if (!isNamePart(c)) {
                lineBegins = c == '\n' || (lineBegins && isBlank(c));
                ++at;
                continue;
            }
            std::size_t end = at + 1;
            while (end < text.size() && isNamePart(text[end])) ++end;
            lineBegins = false;
            if (firstLetters_[static_cast<unsigned char>(c) & 127u])
                if (const auto it = index_.find(text.substr(at, end - at)); it != index_.end())
                    names.push_back(it->second);
            at = end;
        }
    }

    /// Between functions: macros may stand for anything; a function is called by an initial value alone, elsewhere it
    /// is declared.
    void readOutside(std::string_view text) {
        std::vector<std::size_t> names;
        for (std::size_t begin = 0; begin < text.size();) {
            const std::size_t end = std::min(text.find(';', begin), text.size() - 1) + 1;
            const std::string_view statement = text.substr(begin, end - begin);
            const bool hasValue = statement.find('=') != std::string_view::npos;
            names.clear();
            collectNames(statement, names, true);
            for (const std::size_t name : names)
                if (hasValue || name >= functionCount_) outside_.push_back(name);
            begin = end;
        }
    }

    std::vector<Node> nodes_;
    std::size_t functionCount_ = 0;
    std::unordered_map<std::string_view, std::size_t> index_;
    std::array<bool, 128> firstLetters_{};  ///< Of the known names: most words are passed over by one look.
    std::vector<std::size_t> outside_;
};

}  // namespace

std::vector<FunctionRange> findDeadFunctions(std::string_view text, std::string_view entry, const MacroBodies& macros) {
    FunctionWalk walk(text);
    if (!walk.run() || walk.functions.size() < 2) return {};
    CallGraph graph(text, walk.functions, macros);
    if (!graph.follow(entry)) return {};
    std::vector<FunctionRange> dead;
    std::size_t line = 0, counted = 0;
    const auto lineOf = [&](std::size_t offset) {
        line += static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(counted),
                                                    text.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
        counted = offset;
        return line;
    };
    for (FunctionRange& function : walk.functions) {
        if (graph.isLive(function.name) || function.name == "main") continue;
        function.firstLine = lineOf(function.begin);
        function.lastLine = lineOf(function.end);
        dead.push_back(function);
    }
    return dead;
}

}  // namespace crevice::cocos
