// One walk finds the functions, a second one who calls whom; names are enough, as for Cocos' compiler.
#include "cocos/analysis/LiveFunctions.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_set>

#include "cocos/analysis/FunctionWalk.h"
#include "cocos/text/SourceText.h"

namespace crevice::cocos {
namespace {

constexpr std::size_t kAnything = 0;  ///< The node of what may lead to any function.

/// Functions and macros by name, and which names stand in each.
class CallGraph {
public:
    /// `compiled` is the text without what is never compiled; what that names is alive too.
    CallGraph(std::string_view text, std::string_view compiled, const std::vector<FunctionRange>& functions,
              const MacroBodies& macros, const LiveHints& hints)
        : nodes_(1) {
        nodes_[kAnything].pastes = true;
        for (const FunctionRange& function : functions) addNode(function.name);
        functionEnd_ = nodes_.size();
        for (const auto& [name, bodies] : macros) addNode(name);
        for (const auto& [name, bodies] : macros) {
            Node& macro = nodes_[index_[name]];
            for (const std::string_view body : bodies) {
                macro.pastes = macro.pastes || body.find("##") != std::string::npos;
                collectNames(body, macro.names, false);
            }
        }
        for (const std::string_view name : hints.open) nodes_[index_[name]].pastes = true;
        addStructs(text);
        std::size_t at = 0;
        for (const FunctionRange& function : functions) {
            readOutside(compiled.substr(at, function.begin - at));
            readNever(text.substr(at, function.begin - at), compiled.substr(at));
            collectNames(text.substr(function.begin, function.end - function.begin),
                         nodes_[index_[function.name]].names, true);
            if (function.stays) outside_.push_back(index_[function.name]);
            at = function.end;
        }
        readOutside(compiled.substr(at));
        readNever(text.substr(at), compiled.substr(at));
    }

    bool isFunction(std::string_view name) const {
        const auto it = index_.find(name);
        return it != index_.end() && it->second < functionEnd_;
    }

    /// What the functions lead to, and what stands outside of functions, is alive. False when something is alive that
    /// may mean any name, unless `byNameAlone`.
    bool follow(const std::vector<std::string_view>& functions, bool byNameAlone) {
        for (Node& node : nodes_) node.live = false;
        std::vector<std::size_t> waiting = outside_;
        for (const std::string_view function : functions) waiting.push_back(index_[function]);
        while (!waiting.empty()) {
            Node& next = nodes_[waiting.back()];
            waiting.pop_back();
            if (next.live) continue;
            if (next.pastes && !byNameAlone) return false;
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
        lengths_[static_cast<unsigned char>(name.front()) & 127u] |= 1ull << (name.size() & 63u);
    }

    /// The known names of a text; its preprocessor lines are left out: what macros stand for is known. In `code` a call
    /// in capital letters that is nothing of the stage's is a macro of the other stage: it may mean anything.
    void collectNames(std::string_view text, std::vector<std::size_t>& names, bool code,
                      bool lineBegins = false) const {
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
            const std::string_view name = text.substr(at, end - at);
            const bool mayBeKnown = (lengths_[static_cast<unsigned char>(c) & 127u] >> (name.size() & 63u) & 1u) != 0;
            const auto it = mayBeKnown ? index_.find(name) : index_.end();
            if (it != index_.end())
                names.push_back(it->second);
            else if (code && isCalledMacro(name, text.substr(end)) && structs_.count(name) == 0)
                names.push_back(kAnything);
            at = end;
        }
    }

    /// What a struct is named: a call of it is its constructor.
    void addStructs(std::string_view text) {
        constexpr std::string_view kWord = "struct";
        for (std::size_t at = 0; (at = text.find(kWord, at)) != std::string_view::npos; at += kWord.size()) {
            const std::size_t begin = text.find_first_not_of(" \t\n", at + kWord.size());
            if (begin == std::string_view::npos || begin == at + kWord.size() || (at > 0 && isNamePart(text[at - 1])))
                continue;
            if (const std::string_view name = leadingName(text.substr(begin)); !name.empty()) structs_.insert(name);
        }
    }

    static bool isCalledMacro(std::string_view name, std::string_view behind) {
        if (name.front() < 'A' || name.front() > 'Z') return false;
        const std::size_t next = behind.find_first_not_of(" \t");
        return next != std::string_view::npos && behind[next] == '(' &&
               std::none_of(name.begin(), name.end(), [](char c) { return c >= 'a' && c <= 'z'; });
    }

    /// Between functions all that is named is alive, but for a function where it is only declared.
    void readOutside(std::string_view text) {
        bool lineBegins = true;
        int depth = 0;
        std::size_t begin = 0;
        for (std::size_t at = 0; at < text.size(); ++at) {
            const char c = text[at];
            if (c == '#' && lineBegins) at = lineEnd(text, at) - 1;
            lineBegins = c == '\n' || (lineBegins && isBlank(c));
            depth += int(c == '{') - int(c == '}');
            if (depth != 0 || (c != ';' && c != '}')) continue;
            readStatement(text.substr(begin, at + 1 - begin));
            begin = at + 1;
        }
        readStatement(text.substr(begin));
    }

    void readNever(std::string_view text, std::string_view compiled) {
        if (text.data() == compiled.data()) return;
        for (std::size_t at = 0, end; at < text.size(); at = end + 1) {
            end = std::min(text.find('\n', at), text.size());
            const std::string_view line = text.substr(at, end - at);
            if (line != compiled.substr(at, line.size())) collectNames(line, outside_, false, true);
        }
    }

    void readStatement(std::string_view statement) {
        std::vector<std::size_t> names;
        const std::size_t declared = declaredFunction(statement);
        collectNames(statement, names, declared == kAnything, true);
        for (const std::size_t name : names)
            if (name != declared || declared == kAnything) outside_.push_back(name);
    }

    /// The known function that the statement is a prototype of: words that are no macros, and a list.
    std::size_t declaredFunction(std::string_view statement) const {
        if (!statement.ends_with(';') || statement.find_first_of("{=") != std::string_view::npos) return kAnything;
        std::string_view last;
        int words = 0;
        bool lineBegins = true;
        for (std::size_t at = 0; at < statement.size();) {
            const char c = statement[at];
            if (isBlank(c)) {
                lineBegins = lineBegins || c == '\n';
                ++at;
            } else if (c == '#' && lineBegins) {
                at = lineEnd(statement, at);
            } else if (const std::string_view word = leadingName(statement.substr(at)); !word.empty()) {
                const auto it = index_.find(word);
                if (it != index_.end() && it->second >= functionEnd_) return kAnything;
                if (word == "return" || word == "else" || word == "do") return kAnything;  // of a body in branches
                last = word;
                lineBegins = false;
                ++words;
                at += word.size();
            } else {
                return c == '(' && words > 1 && isFunction(last) ? index_.find(last)->second : kAnything;
            }
        }
        return kAnything;
    }

    std::vector<Node> nodes_;
    std::size_t functionEnd_ = 0;
    std::unordered_map<std::string_view, std::size_t> index_;
    /// Of the known names with that first letter: most words are passed over by one look.
    std::array<std::uint64_t, 128> lengths_{};
    std::unordered_set<std::string_view> structs_;
    std::vector<std::size_t> outside_;
};

bool holdsOneOf(std::string_view text, const std::vector<std::string_view>& words) {
    return std::any_of(words.begin(), words.end(), [&](std::string_view word) {
        for (std::size_t at = 0; (at = text.find(word, at)) != std::string_view::npos; at += word.size())
            if (!isNamePart(text[at - 1]) && !isNamePart(text[at + word.size()])) return true;
        return false;
    });
}

void countLines(std::string_view text, std::vector<FunctionRange>& functions) {
    std::size_t line = 0, counted = 0;
    const auto lineOf = [&](std::size_t offset) {
        line += static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(counted),
                                                    text.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
        counted = offset;
        return line;
    };
    for (FunctionRange& function : functions) {
        function.firstLine = lineOf(function.begin);
        function.lastLine = lineOf(function.end);
    }
}

/// Takes those that are alive out of `functions`; all where nothing can be told.
void keepDead(std::string_view text, std::string_view compiled, std::string_view entry, const MacroBodies& known,
              const LiveHints& hints, std::vector<FunctionRange>& functions) {
    CallGraph graph(text, compiled, functions, known, hints);
    if (functions.size() < 2 || !graph.isFunction(entry)) return functions.clear();
    std::vector<std::string_view> roots{entry};
    if (graph.isFunction("main")) roots.emplace_back("main");
    std::size_t next = 0;
    for (const FunctionRange& function : functions) {
        while (next < hints.kept.size() && hints.kept[next] <= function.firstLine) ++next;
        if (next < hints.kept.size() && hints.kept[next] <= function.lastLine) roots.push_back(function.name);
    }
    const bool certain = graph.follow(roots, false);
    if (!certain) graph.follow(roots, true);
    std::erase_if(functions, [&](const FunctionRange& function) {
        return graph.isLive(function.name) ||
               (!certain && !holdsOneOf(text.substr(function.begin, function.end - function.begin), hints.foreign));
    });
}

}  // namespace

std::vector<FunctionRange> findDeadFunctions(std::string_view text, std::string_view entry, const MacroBodies& macros,
                                             const LiveHints& hints) {
    const std::string blanked = hasNever(text) ? withoutNever(text) : std::string();
    const std::string_view compiled = blanked.empty() ? text : std::string_view(blanked);
    MacroBodies known;
    addDefinesOf(compiled, known);
    if (!keepBrackets(known)) return {};
    const auto makers = findFunctionMakers(known);
    for (const auto& [name, bodies] : macros) {
        if (!known.contains(name) && !keepBrackets({{name, bodies}})) return {};
        auto& all = known[name];
        all.insert(all.end(), bodies.begin(), bodies.end());
    }
    for (const std::string_view name : hints.open) known[name];
    FunctionWalk walk(compiled, known, makers);
    if (!walk.run()) return {};
    countLines(text, walk.functions);
    std::vector<FunctionRange> found;
    for (const std::size_t at : walk.emptyStatements) found.push_back({{}, at, at + 1});
    countLines(text, found);
    const auto middle = static_cast<std::ptrdiff_t>(found.size());
    keepDead(text, compiled, entry, known, hints, walk.functions);
    found.insert(found.end(), walk.functions.begin(), walk.functions.end());
    std::inplace_merge(found.begin(), found.begin() + middle, found.end(),
                       [](const FunctionRange& a, const FunctionRange& b) { return a.begin < b.begin; });
    for (FunctionRange& function : found)
        if (!function.name.empty())
            function.name = text.substr(std::size_t(function.name.data() - compiled.data()), function.name.size());
    return found;
}

}  // namespace crevice::cocos
