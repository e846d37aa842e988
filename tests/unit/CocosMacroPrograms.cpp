// Grows random macro programs. Words in small letters are plain; a macro takes as many arguments in every definition.
#include "CocosMacroPrograms.h"

namespace crevice::cocos {
namespace {

constexpr char kIf = '\1', kElse = '\2', kEnd = '\3';  ///< kIf is followed by a switch: 'A', or 'a' for its absence.

enum class Use { Value, Paste, Statement, Head, Number };
constexpr int kNone = -1;

/// Arity kNone: no parameters. `either`: some of its definitions have none.
struct Name {
    const char* text;
    int arity;
    Use use = Use::Value;
    bool either = false;
};
constexpr Name kNames[] = {{"OBJ", kNone},
                           {"VAL", kNone},
                           {"ID", 1},
                           {"ONE", 1},
                           {"ADD", 2},
                           {"MIX", 2},
                           {"BOTH", 1, Use::Value, true},
                           {"NIL", 0},
                           {"ONE_x", 1},
                           {"OBJ_1", kNone},
                           {"GLUE", 2, Use::Paste},
                           {"SET", 2, Use::Statement},
                           {"HEAD", kNone, Use::Head},
                           {"TYPED", 1, Use::Head},
                           {"NUM", kNone, Use::Number},
                           {"SUM", 2, Use::Number}};
constexpr std::size_t kNameCount = std::size(kNames);
constexpr const char* kParameters[] = {"p", "q"};
constexpr const char* kWords[] = {"a", "b", "x", "y.z", "1", "2.5", "vec2"};
constexpr const char* kOperators[] = {" + ", " * ", "-"};

}  // namespace

std::vector<std::string> MacroProgram::names() {
    std::vector<std::string> all;
    for (const Name& name : kNames) all.emplace_back(name.text);
    return all;
}

MacroProgram::MacroProgram(std::uint32_t seed, int size, bool crossing)
    : state_(seed * 2654435761u + 12345u), crossing_(crossing) {
    for (int i = 0; i < 8; ++i) next(2);
    for (int i = 0; i < size / 3; ++i) {
        const std::size_t begin = text_.size();
        addDefine();
        items_.push_back({begin, text_.size()});
    }
    addItems(size, 0);
}

std::uint32_t MacroProgram::next(std::uint32_t below) {
    if (state_ == 0) state_ = 1;
    state_ ^= state_ << 13u;
    state_ ^= state_ >> 17u;
    state_ ^= state_ << 5u;
    return (state_ >> 8u) % below;
}

std::string MacroProgram::source() const {
    std::string all;
    for (std::size_t i = 0; i < text_.size(); ++i) {
        const char c = text_[i];
        if (c == kIf) {
            const bool absent = text_[++i] >= 'a';
            all += std::string(" \\\n#if ") + (absent ? "!USE_" : "USE_") + char(absent ? text_[i] - 32 : text_[i]) +
                   " \\\n";
        } else if (c == kElse) {
            all += " \\\n#else \\\n";
        } else if (c == kEnd) {
            all += std::string(" \\\n#endif") + (text_[i + 1] == '\n' ? "" : " \\\n");
        } else {
            all += c;
        }
    }
    return all;
}

std::string MacroProgram::plain(unsigned variant) const {
    std::string all;
    std::vector<bool> taken{true};
    for (std::size_t i = 0; i < text_.size(); ++i) {
        const char c = text_[i];
        if (c == kIf) {
            const bool absent = text_[++i] >= 'a';
            const unsigned bit = static_cast<unsigned>((text_[i] | 32) - 'a');
            taken.push_back(((variant >> bit & 1u) != 0) != absent);
            all += ' ';
        } else if (c == kElse) {
            taken.back() = !taken.back();
            all += ' ';
        } else if (c == kEnd) {
            taken.pop_back();
            all += ' ';
        } else if (taken.back() && (taken.size() < 3 || taken[taken.size() - 2])) {
            all += c;
        }
    }
    return all;
}

void MacroProgram::addItems(int count, int depth) {
    for (int i = 0; i < count; ++i) {
        const std::uint32_t kind = next(100);
        const std::size_t begin = text_.size();
        if (kind < 40)
            addDefine();
        else if (kind < 55 && depth < 3)
            addCondition(depth);
        else if (kind < 60)
            text_ += std::string("#undef ") + kNames[next(kNameCount)].text + "\n";
        else
            addStatement();
        items_.push_back({begin, text_.size()});
    }
}

MacroProgram MacroProgram::without(std::size_t item) const {
    MacroProgram rest = *this;
    const auto [begin, end] = items_[item];
    rest.text_.erase(begin, end - begin);
    std::erase_if(rest.items_, [&](const Item& one) { return one.begin >= begin && one.end <= end; });
    for (Item& one : rest.items_) {
        if (one.begin >= end) one.begin -= end - begin;
        if (one.end >= end) one.end -= end - begin;
    }
    return rest;
}

void MacroProgram::addDefine() {
    const std::size_t index = next(kNameCount);
    const Name& name = kNames[index];
    const bool guarded = chance(10);
    if (guarded) text_ += std::string("#ifndef ") + name.text + "\n";
    if (!guarded && (written_[index] || chance(5))) text_ += std::string("#undef ") + name.text + "\n";
    written_[index] = true;
    const int arity = name.either && chance(40) ? kNone : name.arity;
    text_ += std::string("#define ") + name.text;
    if (arity == 0) text_ += "()";
    for (int i = 0; i < arity; ++i) text_ += std::string(i == 0 ? "(" : ", ") + kParameters[i];
    text_ += (arity > 0 ? ") " : " ") + body(index, arity) + "\n";
    if (guarded) text_ += "#endif\n";
}

std::string MacroProgram::body(std::size_t index, int arity) {
    const Use use = kNames[index].use;
    if (use == Use::Number) {
        if (arity > 0) return chance(50) ? "((p) + (q))" : "(p)";
        return chance(40) ? "SUM(1, 2)" : std::to_string(next(3));
    }
    if (use == Use::Head) {
        const std::string head = chance(50) ? "in" : "flat in";
        return head + (arity > 0 ? " p" : "");
    }
    if (use == Use::Paste) {
        static constexpr const char* kBodies[] = {"p##q", "p ## _##q", "(p##_x + q)", "OBJ##_##q", "p##_x(q)"};
        return kBodies[next(std::size(kBodies))];
    }
    if (use == Use::Value && arity < 0 && chance(8)) return {};  // With a list, the next line would be the body.
    std::string text = use == Use::Statement ? "p = " + value(arity, 1, false) + ";" : value(arity, 1, false);
    if (use == Use::Value && arity == kNone && chance(15)) text = kNames[next(kNameCount)].text;
    // What a branch of a body ends in is not called with brackets that follow the body.
    if (!chance(30) || (kNames[index].either && arity == kNone)) return text;
    const char which = static_cast<char>((chance(70) ? 'A' : 'a') + static_cast<int>(next(3)));
    const std::string other =
        use == Use::Statement ? " q = " + value(arity, 1, false) + ";" : " + " + value(arity, 1, false);
    text += std::string(1, kIf) + which + other;
    if (chance(50)) text += kElse + (use == Use::Statement ? std::string("p++;") : " - " + value(arity, 1, false));
    text += kEnd;
    return text + (use == Use::Value && chance(50) ? " + z" : "");
}

std::string MacroProgram::condition() {
    const auto switchName = [&] { return std::string(kSwitches[next(3)]); };
    switch (next(7)) {
        case 0:
            return "#if " + switchName() + " && !" + switchName();
        case 1:
            return std::string("#ifdef ") + kNames[next(kNameCount)].text;
        case 2:
            return std::string("#if !defined(") + kNames[next(kNameCount)].text + ")";
        case 3:
            return chance(50) ? "#if NUM > 1" : chance(50) ? "#if 0" : "#if " + switchName() + " \\\n  || USE_B";
        default:
            return "#if " + switchName();
    }
}

void MacroProgram::addCondition(int depth) {
    text_ += condition() + "\n";
    addItems(1 + int(next(3)), depth + 1);
    if (chance(25)) {
        text_ += std::string("#elif ") + kSwitches[next(3)] + "\n";
        addItems(1 + int(next(2)), depth + 1);
    }
    if (chance(50)) {
        text_ += "#else\n";
        addItems(1 + int(next(3)), depth + 1);
    }
    text_ += "#endif\n";
}

/// Small letters are the parameters' too where there are any.
std::string MacroProgram::value(int arity, int depth, bool breaks) {
    std::string text;
    for (std::uint32_t i = 0, count = 1 + next(depth > 1 ? 2 : 3); i < count; ++i) {
        if (i > 0) text += kOperators[next(std::size(kOperators))];
        if (arity > 0 && chance(40))
            text += kParameters[next(std::uint32_t(arity))];
        else if (depth < 3 && chance(55))
            text += call(next(kNameCount), arity, depth + 1, breaks);
        else
            text += kWords[next(std::size(kWords))];
    }
    return text;
}

std::string MacroProgram::call(std::size_t index, int arity, int depth, bool breaks) {
    const Name& name = kNames[index];
    if (name.use == Use::Head || name.use == Use::Statement) return "w";
    std::string text = name.text;
    if (name.arity < 0) return text;
    text += breaks && chance(5) ? "\n (" : "(";
    if (crossing_ && breaks && name.arity == 2 && name.use != Use::Paste && chance(40)) {
        const auto pair = [&] { return "  " + value(arity, depth + 1, true) + ", " + value(arity, depth + 1, true); };
        return text + "\n" + condition() + "\n" + pair() + "\n#else\n" + pair() + "\n#endif\n)";
    }
    for (int i = 0; i < name.arity; ++i) {
        if (i > 0) text += chance(20) && breaks ? ",\n  " : ", ";
        if (name.use == Use::Paste) {
            text += chance(60) ? (i == 0 ? "ONE" : "x") : kWords[next(3)];
        } else {
            text += breaks && chance(25) ? branches(arity, depth) : value(arity, depth, breaks);
        }
    }
    return text + ")";
}

std::string MacroProgram::branches(int arity, int depth) {
    std::string text = "\n" + condition() + "\n  " + value(arity, depth + 1, true) + "\n";
    if (chance(70))
        text += "#else\n  " + value(arity, depth + 1, true) + "\n#endif\n";
    else
        text += "#endif\n  " + value(arity, depth + 1, true);
    return text;
}

void MacroProgram::addStatement() {
    switch (next(crossing_ ? 8 : 6)) {
        case 6:
        case 7: {
            const auto rest = [&] { return "  " + value(0, 1, true) + ") + " + value(0, 1, true) + ";\n"; };
            text_ += "float f = " + std::string(chance(50) ? "ADD" : "MIX") + "(" + value(0, 1, true) + ",\n" +
                     condition() + "\n" + rest() + "#else\n" + rest() + "#endif\n";
            break;
        }
        case 0:
            text_ += "HEAD vec2 v" + std::to_string(next(9)) + ";\n";
            break;
        case 1:
            text_ += "TYPED(vec3) v" + std::to_string(next(9)) + ";\n";
            break;
        case 2:
            text_ += "SET(b, " + (chance(40) ? branches(0, 1) : value(0, 1, true)) + ");\n";
            break;
        default:
            text_ += "float f" + std::to_string(next(9)) + " = " + value(0, 0, true) + ";\n";
    }
}

}  // namespace crevice::cocos
