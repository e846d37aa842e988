// Comments blanked, lines classified, macros taken apart.
#include "cocos/text/SourceText.h"

#include <algorithm>
#include <utility>

#include "cocos/text/ArgumentDeclarations.h"
#include "cocos/text/Conditions.h"
#include "cocos/text/Splices.h"

namespace crevice::cocos {
namespace {

constexpr std::pair<std::string_view, LineKind> kDirectives[] = {
    {"include", LineKind::Include}, {"define", LineKind::Define},   {"undef", LineKind::Undef},
    {"if", LineKind::If},           {"ifdef", LineKind::Ifdef},     {"ifndef", LineKind::Ifndef},
    {"elif", LineKind::Elif},       {"else", LineKind::Else},       {"endif", LineKind::Endif},
    {"pragma", LineKind::Pragma},   {"version", LineKind::Dropped}, {"line", LineKind::Dropped},
    {"extension", LineKind::Other}, {"error", LineKind::Other}};

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

bool endsWithBackslash(std::string_view line) {
    line = trimBlank(line);
    return !line.empty() && line.back() == '\\';
}

std::string_view withoutBackslash(std::string_view line) {
    if (!endsWithBackslash(line)) return line;
    return line.substr(0, line.rfind('\\'));
}

/// Comments become spaces, lines stay. A comment ends with its line, as in Cocos: the backslash behind a comment in a
/// preprocessor line still continues that line.
std::string blankComments(std::string_view text) {
    std::string out(text);
    bool inBlock = false, inDirective = false, continued = false;
    for (std::size_t begin = 0; begin < out.size();) {
        const std::size_t end = std::min(out.find('\n', begin), out.size());
        const std::string_view line = std::string_view(out).substr(begin, end - begin);
        const bool splice = endsWithBackslash(line);
        const std::size_t word = std::min(line.find_first_not_of(" \t\r"), line.size());
        inDirective = (continued && inDirective) || (!inBlock && word < line.size() && line[word] == '#');
        continued = splice;
        const std::size_t last = splice ? begin + line.rfind('\\') : end;
        for (std::size_t i = begin; i < end; ++i) {
            const char next = i + 1 < end ? out[i + 1] : '\0';
            if (inBlock) {
                const bool closes = out[i] == '*' && next == '/';
                if (i != last || !inDirective) out[i] = ' ';
                if (closes) out[++i] = ' ';
                inBlock = !closes;
            } else if (out[i] == '/' && next == '*') {
                inBlock = true;
                out[i] = out[i + 1] = ' ';
                ++i;
            } else if (out[i] == '/' && next == '/') {
                std::fill(out.begin() + static_cast<std::ptrdiff_t>(i), out.begin() + static_cast<std::ptrdiff_t>(end),
                          ' ');
                if (splice && inDirective) out[last] = '\\';
                break;
            } else if (out[i] == '\r') {
                out[i] = ' ';
            }
        }
        begin = end + 1;
    }
    if (out.starts_with("\xEF\xBB\xBF")) out.replace(0, 3, "   ");
    return out;
}

bool isDirectiveText(std::string_view text) {
    text = trimBlank(text);
    return text.starts_with('#') && !text.starts_with("##") && readDirective(text).kind != LineKind::Code;
}

/// An interface word outside of all brackets.
bool declaresInterface(const std::vector<MacroDefinition::BodyLine>& body) {
    int depth = 0;
    for (const auto& part : body) {
        for (std::size_t i = 0; i < part.text.size();) {
            const char c = part.text[i];
            if (isNameStart(c)) {
                const std::string_view word = leadingName(part.text.substr(i));
                if (depth == 0 && isInterfaceWord(word)) return true;
                i += word.size();
                continue;
            }
            if (c == '(' || c == '{') ++depth;
            if (c == ')' || c == '}') --depth;
            ++i;
        }
    }
    return false;
}

/// More braces of one kind than of the other: nobody could tell where what it begins ends.
bool opensOrCloses(const std::vector<MacroDefinition::BodyLine>& body) {
    std::ptrdiff_t depth = 0;
    for (const auto& part : body)
        depth +=
            std::count(part.text.begin(), part.text.end(), '{') - std::count(part.text.begin(), part.text.end(), '}');
    return depth != 0;
}

/// Splits a text into lines and finds out what each one is.
class Reader {
public:
    Reader(SourceText& source, int firstLine) : source_(source), firstLine_(firstLine) {}

    void run() {
        splitLines();
        for (std::size_t at = 0; at < source_.lines.size();) at += readLine(at);
        for (MacroDefinition& macro : source_.macros) macro.source = &source_;
        for (std::size_t at = 0; at < source_.lines.size(); at += source_.lines[at].span)
            if (isConditional(source_.lines[at].kind)) addSplitCalls(at);
    }

private:
    void splitLines() {
        const std::string_view text = source_.text;
        int line = firstLine_;
        bool continued = false;
        for (std::size_t begin = 0; begin < text.size(); ++line) {
            const std::size_t end = std::min(text.find('\n', begin), text.size());
            std::string_view part = text.substr(begin, end - begin);
            while (!part.empty() && isBlank(part.back())) part.remove_suffix(1);
            // A blank line is dropped, unless it ends a macro's last continuation.
            if (!trimBlank(part).empty() || continued) source_.lines.push_back({part, line, LineKind::Code, 1, -1});
            continued = endsWithBackslash(part);
            begin = end + 1;
        }
    }

    std::size_t readLine(std::size_t at) {
        SourceLine& line = source_.lines[at];
        const Directive directive = readDirective(line.text);
        line.kind = directive.kind;
        if (line.kind == LineKind::Code) return 1;
        while (at + line.span < source_.lines.size() && endsWithBackslash(source_.lines[at + line.span - 1].text))
            ++line.span;
        if (isConditional(line.kind)) readConditional(at, directive);
        line.conditional = isInCondition();
        if (line.kind == LineKind::Define) readMacro(at, directive.rest, false);
        if (line.kind == LineKind::Pragma && leadingName(directive.rest) == "define") {
            const std::string_view tail = trimBlank(directive.rest.substr(6));
            const std::string_view name = leadingName(tail);
            const bool called = !name.empty() && name.size() < tail.size() && tail[name.size()] == '(';
            const bool multiline = line.span > 1;
            if (!name.empty() && (called || multiline || !isMetaTail(trimBlank(tail.substr(name.size()))))) {
                line.kind = LineKind::PragmaDefine;
                readMacro(at, tail, true);
            }
        }
        return source_.lines[at].span;
    }

    /// Follows what version 450 decides: branches that it never takes are dead.
    void readConditional(std::size_t at, const Directive& directive) {
        if (directive.kind == LineKind::Endif) {
            if (!open_.empty()) open_.pop_back();
            return;
        }
        const bool opens = directive.kind != LineKind::Elif && directive.kind != LineKind::Else;
        if (opens) open_.emplace_back();
        if (open_.empty()) return;
        Branch& branch = open_.back();
        branch.guarded = directive.kind == LineKind::Ifndef ? leadingName(directive.rest) : std::string_view();
        branch.isGuard = false;
        std::optional<bool> taken;
        if (directive.kind == LineKind::If || directive.kind == LineKind::Elif)
            taken = decideByVersion(readDirective(joinLines(at)).rest);
        else if (directive.kind == LineKind::Else)
            taken = true;
        branch.dead = branch.decided || taken == false;
        if (taken == true) branch.decided = true;
    }

    std::string joinLines(std::size_t at) const {
        std::string joined;
        for (std::size_t i = at; i < at + source_.lines[at].span; ++i)
            joined.append(withoutBackslash(source_.lines[i].text)).push_back(' ');
        return joined;
    }

    bool isInCondition() const {
        return std::any_of(open_.begin(), open_.end(), [](const Branch& branch) { return !branch.isGuard; });
    }

    void readMacro(std::size_t at, std::string_view rest, bool fromPragma) {
        MacroDefinition macro;
        macro.name = leadingName(rest);
        if (macro.name.empty()) return;
        macro.fromPragma = fromPragma;
        macro.conditional = isInCondition();
        if (!open_.empty() && open_.back().guarded == macro.name) open_.back().isGuard = true;
        macro.dead = std::any_of(open_.begin(), open_.end(), [](const Branch& branch) { return branch.dead; });
        rest.remove_prefix(macro.name.size());
        if (rest.starts_with('(')) {
            const auto close = rest.find(')');
            if (close == std::string_view::npos) return;
            macro.functionLike = true;
            readParameters(rest.substr(1, close - 1), macro);
            rest.remove_prefix(close + 1);
        }
        SourceLine& line = source_.lines[at];
        macro.body.push_back({trimBlank(rest), line.line});
        for (std::size_t i = 1; i < line.span; ++i) {
            const SourceLine& part = source_.lines[at + i];
            macro.body.push_back({withoutBackslash(part.text), part.line});
        }
        if (macro.functionLike && line.span == 1 && macro.body[0].text.empty()) adoptNextLine(at, macro);
        while (macro.body.size() > 1 && trimBlank(macro.body.back().text).empty()) macro.body.pop_back();
        if (macro.body.size() > 1 && macro.body.front().text.empty()) macro.body.erase(macro.body.begin());
        macro.bearsDirectives = std::any_of(macro.body.begin(), macro.body.end(),
                                            [](const auto& part) { return isDirectiveText(part.text); });
        macro.declares = declaresInterface(macro.body) || opensOrCloses(macro.body);
        line.macro = static_cast<int>(source_.macros.size());
        source_.macros.push_back(std::move(macro));
    }

    static void readParameters(std::string_view list, MacroDefinition& macro) {
        while (!trimBlank(list).empty()) {
            const auto comma = std::min(list.find(','), list.size());
            macro.parameters.push_back(trimBlank(list.substr(0, comma)));
            list.remove_prefix(std::min(comma + 1, list.size()));
        }
    }

    /// Cocos' compiler looks for the body behind the parentheses, over the end of the line.
    void adoptNextLine(std::size_t at, MacroDefinition& macro) {
        if (at + 1 >= source_.lines.size()) return;
        const SourceLine& next = source_.lines[at + 1];
        if (next.line != source_.lines[at].line + 1 || readDirective(next.text).kind != LineKind::Code) return;
        macro.adoptsNextLine = true;
        macro.body = {{trimBlank(next.text), next.line}};
        source_.lines[at].span = 2;
    }

    /// Looks back from a condition for brackets that its statement leaves open.
    void addSplitCalls(std::size_t directive) {
        OpenCalls open(source_.splitCalls);
        for (std::size_t at = directive; at-- > 0 && directive - at <= kMostCallLines;) {
            if (isConditional(source_.lines[at].kind)) return;  // It looked back itself.
            if (isCodeLine(source_, at) && !open.readBack(source_.lines[at].text)) return;
        }
    }

    struct Branch {
        bool decided = false;  ///< An earlier branch, or this one, is taken for certain.
        bool dead = false;
        bool isGuard = false;  ///< It asks for the absence of a name that it defines.
        std::string_view guarded;
    };
    SourceText& source_;
    int firstLine_;
    std::vector<Branch> open_;
};

}  // namespace

bool OpenCalls::readBack(std::string_view text) {
    const auto takeName = [&](std::size_t end) {
        while (end > 0 && isBlank(text[end - 1])) --end;
        std::size_t begin = end;
        while (begin > 0 && isNamePart(text[begin - 1])) --begin;
        if (begin < end) names_.insert(text.substr(begin, end - begin));
        nameAbove_ = end == 0;
    };
    if (nameAbove_) takeName(text.size());
    for (std::size_t at = text.size(); at-- > 0;) {
        if (text[at] == ';' || text[at] == '{' || text[at] == '}') return false;
        if (text[at] == ')') ++closed_;
        if (text[at] != '(') continue;
        if (closed_ == 0)
            takeName(at);
        else
            --closed_;
    }
    return true;
}

bool isCodeLine(const SourceText& source, std::size_t at) {
    return source.lines[at].kind == LineKind::Code && (at == 0 || !endsWithBackslash(source.lines[at - 1].text));
}

bool isInterfaceWord(std::string_view word) {
    return word == "in" || word == "out" || word == "uniform" || word == "buffer" || word == "attribute" ||
           word == "varying";
}

bool isConditional(LineKind kind) { return kind >= LineKind::If && kind <= LineKind::Endif; }

std::string_view trimBlank(std::string_view text) {
    while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
    while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
    return text;
}

std::string_view leadingName(std::string_view text) {
    if (text.empty() || !isNameStart(text.front())) return {};
    std::size_t end = 1;
    while (end < text.size() && isNamePart(text[end])) ++end;
    return text.substr(0, end);
}

std::string_view nameBefore(std::string_view text, std::size_t at) {
    while (at > 0 && (isBlank(text[at - 1]) || text[at - 1] == '\n')) --at;
    std::size_t begin = at;
    while (begin > 0 && isNamePart(text[begin - 1])) --begin;
    return text.substr(begin, at - begin);
}

Directive readDirective(std::string_view text) {
    text = trimBlank(text);
    if (!text.starts_with('#')) return {};
    text = trimBlank(withoutBackslash(text.substr(1)));
    const std::string_view word = leadingName(text);
    const std::string_view rest = trimBlank(text.substr(word.size()));
    for (const auto& [name, kind] : kDirectives)
        if (word == name) return {kind, rest};
    if (word.empty() && rest.empty()) return {LineKind::Dropped, {}};  // The null directive.
    return {word.empty() ? LineKind::Code : LineKind::Other, rest};
}

std::string defineLine(const MacroDefinition& macro) {
    std::string line = "#define " + std::string(macro.name);
    if (macro.functionLike) line += '(';
    for (const std::string_view parameter : macro.parameters)
        line.append(parameter == macro.parameters.front() ? "" : ", ").append(parameter);
    if (macro.functionLike) line += ')';
    for (const auto& part : macro.body) line.append(" ").append(trimBlank(part.text));
    return line;
}

bool isMetaTail(std::string_view tail) {
    if (tail.empty()) return true;
    const std::string_view word = leadingName(tail);
    if (word != "range" && word != "options" && word != "default" && word != "editor") return false;
    return trimBlank(tail.substr(word.size())).starts_with('(');
}

std::unique_ptr<SourceText> readSource(std::string_view text, const std::string& shown, const std::string& file,
                                       const std::filesystem::path& folder, int firstLine) {
    auto source = std::make_unique<SourceText>();
    source->shown = shown;
    source->file = file;
    source->folder = folder;
    source->text = joinParted(blankComments(text));
    Reader(*source, firstLine).run();
    source->declaringCalls = callsWithDeclarations(*source);
    return source;
}

}  // namespace crevice::cocos
