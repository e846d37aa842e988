// Sizes of macros as linear functions of their arguments.
#include "cocos/analysis/MacroWeight.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace crevice::cocos {
namespace {

constexpr double kHuge = 1e30;

constexpr std::array<bool, 256> kOperators = [] {
    std::array<bool, 256> operators{};
    for (const char c : std::string_view("+-*/%&|^<>=!?~")) operators[static_cast<unsigned char>(c)] = true;
    return operators;
}();

bool isOperator(char c) { return kOperators[static_cast<unsigned char>(c)]; }

constexpr double kHeavy = 100;  ///< Words: lighter macros cannot add up before the text itself is too large.
constexpr int kMaxDepth = 100;  ///< Nesting of calls, and of macros in macros.

/// A word in a line of the text (counted from 1), or the line without its indentation.
SourceLoc placeInLine(const FlatSource& flat, int line, std::string_view word) {
    std::string_view text = flat.text;
    for (int i = 1; i < line; ++i) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    text = text.substr(0, text.find('\n'));
    auto at = word.empty() ? std::string_view::npos : text.find(word);
    std::size_t length = word.size();
    if (at == std::string_view::npos) {
        at = std::min(text.find_first_not_of(" \t"), text.size());
        length = std::clamp<std::size_t>(text.size() - at, 1, 200);
    }
    return flat.locate(line, static_cast<int>(at) + 1, static_cast<int>(length));
}

std::string_view namePartsAt(std::string_view text, std::size_t at) {
    std::size_t end = at;
    while (end < text.size() && isNamePart(text[end])) ++end;
    return text.substr(at, end - at);
}

struct Words {
    double total = 0, statement = 0;  ///< Of macros so far; of the present statement.
};

/// Of the branches of a condition the compiler sees one: the heaviest counts.
class Alternatives {
public:
    void follow(LineKind kind, Words& now) {
        const bool opens = kind == LineKind::If || kind == LineKind::Ifdef || kind == LineKind::Ifndef;
        if (opens) open_.push_back({now, {}, false});
        if (opens || !isConditional(kind) || open_.empty()) return;
        Condition& last = open_.back();
        last.heaviest = heavier(last.heaviest, now);
        last.hasElse = last.hasElse || kind == LineKind::Else;
        now = last.before;
        if (kind != LineKind::Endif) return;
        now = last.hasElse ? last.heaviest : heavier(last.heaviest, last.before);
        open_.pop_back();
    }

private:
    struct Condition {
        Words before, heaviest;
        bool hasElse = false;
    };
    static Words heavier(const Words& a, const Words& b) {
        return {std::max(a.total, b.total), std::max(a.statement, b.statement)};
    }
    std::vector<Condition> open_;
};

}  // namespace

/// Moves over a text word by word and knows the macros' calls.
struct MacroWeights::Scanner {
    MacroWeights& weights;
    std::string_view text;
    const std::vector<std::string_view>& parameters;
    std::size_t at = 0;

    Linear zero() const { return {0, std::vector<double>(parameters.size(), 0.0)}; }

    static void add(Linear& sum, const Linear& part, double factor) {
        if (factor == 0) return;
        sum.constant = std::min(kHuge, sum.constant + factor * part.constant);
        for (std::size_t i = 0; i < part.factors.size() && i < sum.factors.size(); ++i)
            sum.factors[i] = std::min(kHuge, sum.factors[i] + factor * part.factors[i]);
    }

    /// Up to the end, or in a call to the next ',' or ')' of its own.
    Linear sum(bool inCall) {
        Linear total = zero();
        int open = 0;
        while (at < text.size()) {
            const char c = text[at];
            if (isNameStart(c)) {
                add(total, word(), 1);
                continue;
            }
            if (inCall && open == 0 && (c == ',' || c == ')')) break;
            if (c == '(') ++open;
            if (c == ')' && open > 0) --open;
            if (c == ' ' || c == '\t' || c == '\n') {
                ++at;
                continue;
            }
            total.constant += 1;
            ++at;
            while (isNamePart(c) && at < text.size() && (isNamePart(text[at]) || text[at] == '.')) ++at;
        }
        return total;
    }

    Linear word() {
        const std::string_view name = leadingName(text.substr(at));
        at += name.size();
        Linear total = zero();
        const auto parameter = std::find(parameters.begin(), parameters.end(), name);
        if (parameter != parameters.end()) {
            total.factors[static_cast<std::size_t>(parameter - parameters.begin())] = 1;
            return total;
        }
        total.constant = 1;
        Entry* entry = weights.find(name);
        if (entry == nullptr || entry->busy) return total;
        if (!entry->functionLike) {
            add(total, {weights.weightOf(*entry).constant, {}}, 1);
            return total;
        }
        const std::size_t bracket = std::min(text.find_first_not_of(" \t\n", at), text.size());
        if (bracket == text.size() || text[bracket] != '(') return total;
        at = bracket + 1;
        call(*entry, total);
        return total;
    }

    void call(Entry& entry, Linear& total) {
        const Linear weight = weights.weightOf(entry);
        total.constant = std::min(kHuge, total.constant + weight.constant);
        if (++weights.depth_ > kMaxDepth) total.constant = kHuge;
        for (std::size_t i = 0; at < text.size() && weights.depth_ <= kMaxDepth; ++i) {
            const Linear argument = sum(true);
            add(total, argument, i < weight.factors.size() ? weight.factors[i] : 0);
            const bool ends = at >= text.size() || text[at] == ')';
            if (at < text.size()) ++at;
            if (ends) break;
        }
        --weights.depth_;
    }
};

void MacroWeights::add(const MacroDefinition& macro) {
    Entry& entry = entries_[macro.name];
    entry.definitions.push_back(&macro);
    entry.functionLike = entry.functionLike || macro.functionLike;
}

/// Follows `#define F G` to G: a call of F is one of G.
MacroWeights::Entry* MacroWeights::find(std::string_view name) {
    for (int i = 0; i < 16; ++i) {
        const auto it = entries_.find(name);
        if (it == entries_.end()) return nullptr;
        const auto& definitions = it->second.definitions;
        if (it->second.functionLike || definitions.size() != 1 || definitions[0]->body.size() != 1) return &it->second;
        const std::string_view body = trimBlank(definitions[0]->body[0].text);
        if (body.empty() || leadingName(body) != body || !entries_.contains(body)) return &it->second;
        name = body;
    }
    return nullptr;
}

const MacroWeights::Linear& MacroWeights::weightOf(Entry& entry) {
    if (entry.known) return entry.weight;
    entry.busy = true;
    if (++depth_ > kMaxDepth) entry.weight.constant = kHuge;
    for (const MacroDefinition* macro : entry.definitions) {
        if (depth_ > kMaxDepth) break;
        Linear total{0, std::vector<double>(macro->parameters.size(), 0.0)};
        for (const auto& part : macro->body) Scanner::add(total, measure(part.text, macro->parameters), 1);
        entry.weight.constant = std::max(entry.weight.constant, total.constant);
        entry.weight.factors.resize(std::max(entry.weight.factors.size(), total.factors.size()), 0.0);
        for (std::size_t i = 0; i < total.factors.size(); ++i)
            entry.weight.factors[i] = std::max(entry.weight.factors[i], total.factors[i]);
    }
    --depth_;
    entry.busy = false;
    entry.known = true;
    return entry.weight;
}

MacroWeights::Linear MacroWeights::measure(std::string_view text, const std::vector<std::string_view>& parameters) {
    return Scanner{*this, text, parameters}.sum(false);
}

int MacroWeights::firstTooHeavy(std::string_view text, std::string_view& macro) {
    std::unordered_map<std::string_view, Entry*> heavy;
    bool letters[128] = {};
    for (auto& [name, entry] : entries_) {
        const Linear& weight = weightOf(entry);
        const bool multiplies =
            std::any_of(weight.factors.begin(), weight.factors.end(), [](double factor) { return factor > 1; });
        if (!multiplies && weight.constant < kHeavy) continue;
        heavy.emplace(name, &entry);
        letters[static_cast<unsigned char>(name.front()) & 127u] = true;
    }
    const auto lineOf = [&](std::size_t at) {
        return static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n')) + 1;
    };
    const std::vector<std::string_view> none;
    const auto isHeavy = [&](std::string_view name) {
        return letters[static_cast<unsigned char>(name.front()) & 127u] && heavy.contains(name);
    };
    Scanner scanner{*this, text, none};
    Words now;
    double conditions = 0;
    Alternatives alternatives;
    // The compiler's preprocessor expands what conditions call as well.
    const auto heavyWords = [&](std::string_view line, std::string_view& heaviest) {
        double words = 0;
        for (Scanner inner{*this, line, none}; inner.at < line.size();) {
            const std::string_view name = namePartsAt(line, inner.at);
            if (name.empty() || !isHeavy(name)) {
                inner.at += std::max<std::size_t>(1, name.size());
                continue;
            }
            words += inner.word().constant;
            if (conditions + words + now.total > kMaxWords && heaviest.empty()) heaviest = name;
        }
        return words;
    };
    bool lineStart = true;
    while (scanner.at < text.size()) {
        const char c = text[scanner.at];
        if (isNamePart(c)) {
            const std::string_view name = namePartsAt(text, scanner.at);
            lineStart = false;
            if (!isHeavy(name)) {
                scanner.at += name.size();
                continue;
            }
            const std::size_t begin = scanner.at;
            const double words = scanner.word().constant;
            now.total += words;
            now.statement += words;
            if (now.total + conditions > kMaxWords) macro = name;
            if (!macro.empty() || now.statement > kMaxStatement) return lineOf(begin);
            continue;
        }
        const LineKind kind = lineStart && c == '#' ? readDirective(text.substr(scanner.at, 64)).kind : LineKind::Code;
        if (kind != LineKind::Code) {
            // Continued or not: no word of it belongs to a statement, and no macro is expanded where it is defined.
            alternatives.follow(kind, now);
            std::size_t end = std::min(text.find('\n', scanner.at), text.size());
            while (end < text.size() && text[end - 1] == '\\') end = std::min(text.find('\n', end + 1), text.size());
            const std::string_view line = text.substr(scanner.at, end - scanner.at);
            if (kind == LineKind::If || kind == LineKind::Elif) conditions += heavyWords(line, macro);
            if (!macro.empty()) return lineOf(scanner.at);
            scanner.at = end;
            continue;
        }
        if (c == ';' || c == '{' || c == '}')
            now.statement = 0;
        else if (c == ',')
            now.statement += 1;
        else if (isOperator(c))
            now.statement += 2;
        if (now.statement > kMaxStatement) return lineOf(scanner.at);
        lineStart = c == '\n' || (lineStart && (c == ' ' || c == '\t'));
        ++scanner.at;
    }
    return 0;
}

void MacroWeights::check(const FlatSource& flat, Problems& problems) {
    std::string_view heaviest;
    const int line = firstTooHeavy(flat.text, heaviest);
    if (line == 0) return;
    const SourceLoc where = placeInLine(flat, line, heaviest);
    if (heaviest.empty())
        return problems.error(where, "this statement is longer than the compiler can take", "split it, or use a loop");
    problems.error(where, fmt::format("macro '{}' stands for more than {} words here", heaviest, kMaxWords),
                   "macros multiply each other: write out what is meant");
}

}  // namespace crevice::cocos
