// A recursive-descent reader of preprocessor expressions (GLSL 4.50, section 3.3) over known and unknown values.
#include "cocos/text/Conditions.h"

#include <charconv>

#include "cocos/text/SourceText.h"

namespace crevice::cocos {
namespace {

constexpr int kMaxDepth = 200;
constexpr std::string_view kOperators[] = {"||", "&&", "==", "!=", "<=", ">=", "<<", ">>", "<", ">", "+", "-",
                                           "*",  "/",  "%",  "&",  "|",  "^",  "!",  "~",  "(", ")", ","};

int precedenceOf(std::string_view op) {
    if (op == "||") return 1;
    if (op == "&&") return 2;
    if (op == "|") return 3;
    if (op == "^") return 4;
    if (op == "&") return 5;
    if (op == "==" || op == "!=") return 6;
    if (op == "<" || op == ">" || op == "<=" || op == ">=") return 7;
    if (op == "<<" || op == ">>") return 8;
    if (op == "+" || op == "-") return 9;
    if (op == "*" || op == "/" || op == "%") return 10;
    return 0;
}

std::optional<long long> calculate(std::string_view op, long long a, long long b) {
    const auto wide = [](long long v) { return static_cast<unsigned long long>(v); };
    if (op == "||") return a != 0 || b != 0;
    if (op == "&&") return a != 0 && b != 0;
    if (op == "|") return a | b;
    if (op == "^") return a ^ b;
    if (op == "&") return a & b;
    if (op == "==") return a == b;
    if (op == "!=") return a != b;
    if (op == "<") return a < b;
    if (op == ">") return a > b;
    if (op == "<=") return a <= b;
    if (op == ">=") return a >= b;
    if (op == "<<" || op == ">>") {
        if (b < 0 || b > 62) return std::nullopt;
        return op == "<<" ? static_cast<long long>(wide(a) << b) : a >> b;
    }
    if (op == "+") return static_cast<long long>(wide(a) + wide(b));
    if (op == "-") return static_cast<long long>(wide(a) - wide(b));
    if (op == "*") return static_cast<long long>(wide(a) * wide(b));
    if (b == 0 || b == -1) return std::nullopt;
    return op == "/" ? a / b : a % b;
}

Condition constant(long long value) {
    Condition result;
    result.value = value;
    return result;
}

class Reader {
public:
    Reader(std::string_view text, const NameLookup& lookup) : text_(text), lookup_(lookup) {}

    Condition run() {
        advance();
        Condition result = readBinary(1);
        if (failed_ || !word_.empty()) result = {};
        result.tooDeep = tooDeep_;
        return result;
    }

private:
    void advance() {
        text_ = trimBlank(text_);
        if (text_.empty()) {
            word_ = {};
            return;
        }
        word_ = leadingName(text_);
        if (word_.empty() && text_[0] >= '0' && text_[0] <= '9') {
            std::size_t end = 1;
            while (end < text_.size() && isNamePart(text_[end])) ++end;
            word_ = text_.substr(0, end);
        }
        for (std::size_t i = 0; word_.empty() && i < std::size(kOperators); ++i)
            if (text_.starts_with(kOperators[i])) word_ = text_.substr(0, kOperators[i].size());
        if (word_.empty()) failed_ = true;
        text_.remove_prefix(word_.size());
    }

    Condition readBinary(int level) {
        if (++depth_ > kMaxDepth) failed_ = tooDeep_ = true;
        Condition left = failed_ ? Condition{} : readUnary();
        while (!failed_) {
            const std::string_view op = word_;
            const int precedence = precedenceOf(op);
            if (precedence < level || precedence == 0) break;
            advance();
            left = combine(op, left, readBinary(precedence + 1));
        }
        --depth_;
        return left;
    }

    static Condition combine(std::string_view op, const Condition& a, const Condition& b) {
        Condition result;
        if (a.value && b.value) {
            result.value = calculate(op, *a.value, *b.value);
            return result;
        }
        if (op != "&&" && op != "||") return result;
        for (const auto* one : {&a, &b})
            if (one->value && (*one->value != 0) == (op == "||")) return constant(op == "||" ? 1 : 0);
        return result;
    }

    Condition readUnary() {
        if (word_ == "!" || word_ == "-" || word_ == "+" || word_ == "~") {
            if (++depth_ > kMaxDepth) failed_ = tooDeep_ = true;
            const std::string_view op = word_;
            advance();
            Condition operand = failed_ ? Condition{} : readUnary();
            --depth_;
            if (op == "!" && operand.value) operand.value = *operand.value == 0 ? 1 : 0;
            if (operand.value && op == "-") operand.value = calculate("-", 0, *operand.value);
            if (operand.value && op == "~") operand.value = ~*operand.value;
            return operand;
        }
        if (word_ == "(") {
            advance();
            Condition inner = readBinary(1);
            if (word_ != ")") failed_ = true;
            if (!failed_) advance();
            return inner;
        }
        if (word_ == "defined") return readDefined();
        if (!leadingName(word_).empty()) return readName();
        return readNumber();
    }

    Condition readDefined() {
        advance();
        const bool bracket = word_ == "(";
        if (bracket) advance();
        Condition result;
        if (leadingName(word_).empty()) failed_ = true;
        if (!failed_) lookup_(word_, false);
        if (!failed_) advance();
        if (bracket && word_ != ")") failed_ = true;
        if (bracket && !failed_) advance();
        return result;
    }

    Condition readName() {
        const std::string_view word = word_;
        advance();
        if (word == "__VERSION__") return constant(450);
        if (word_ == "(") skipArguments();
        const ConditionName name = lookup_(word, true);
        Condition result;
        result.value = name.value;
        return result;
    }

    /// A function-like macro's call says nothing simple.
    void skipArguments() {
        int depth = 0;
        do {
            if (word_ == "(") ++depth;
            if (word_ == ")") --depth;
            if (word_.empty()) failed_ = true;
            if (!failed_) advance();
        } while (depth > 0 && !failed_);
    }

    Condition readNumber() {
        Condition result;
        std::string_view digits = word_;
        while (!digits.empty() && (digits.back() == 'u' || digits.back() == 'U')) digits.remove_suffix(1);
        const bool hex = digits.starts_with("0x") || digits.starts_with("0X");
        if (hex) digits.remove_prefix(2);
        const int base = hex ? 16 : digits.size() > 1 && digits[0] == '0' ? 8 : 10;
        long long value = 0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
        if (digits.empty() || error != std::errc{} || end != digits.data() + digits.size()) failed_ = true;
        result.value = value;
        if (!failed_) advance();
        return result;
    }

    std::string_view text_, word_;
    const NameLookup& lookup_;
    int depth_ = 0;
    bool failed_ = false, tooDeep_ = false;
};

}  // namespace

Condition readCondition(std::string_view expression, const NameLookup& lookup) {
    return Reader(expression, lookup).run();
}

KeptNames keepNames(std::string_view expression, const NameLookup& lookup) {
    KeptNames kept;
    std::string last;  // The name that a comparison would make a number; empty = it stands for something else.
    bool either = false, asked = false;
    for (expression = trimBlank(expression); !expression.empty(); expression = trimBlank(expression)) {
        const std::string_view word = expression.substr(0, expression.find_first_of(" \t"));
        expression.remove_prefix(word.size());
        if (word == "||") either = true;
        if (!last.empty() && word.find_first_not_of("<=>") == std::string_view::npos) kept.compared.push_back(last);
        std::size_t at = 0;
        while (at < word.size() && !isNameStart(word[at])) ++at;
        std::string_view name = leadingName(word.substr(at));
        const bool asks = name == "defined";
        if (asks) name = leadingName(word.substr(std::min(word.find('(', at), word.size() - 1) + 1));
        const bool defined = asks || asked;
        if (asks || !name.empty()) asked = name.empty();  // `defined X`, `defined( X )`: the next word says of what.
        if (name.empty() || name == "__VERSION__") continue;
        const ConditionName meaning = lookup(name, !defined);
        last = meaning.outside ? std::string(name) : std::string();
        const std::string sign = word.starts_with('!') ? "!" : "";
        if (meaning.outside) kept.needs.push_back(sign + std::string(name));
        for (const std::string& alias : meaning.alias) kept.needs.push_back(sign + alias);
    }
    if (either) kept.needs.clear();
    return kept;
}

std::vector<std::string> turnRound(const std::vector<std::string>& needs) {
    std::vector<std::string> turned;
    for (const std::string& need : needs) turned.push_back(need.starts_with('!') ? need.substr(1) : "!" + need);
    return turned;
}

std::optional<bool> decideByVersion(std::string_view expression) {
    const auto value = readCondition(expression, [](std::string_view, bool) { return ConditionName{}; }).value;
    if (!value) return std::nullopt;
    return *value != 0;
}

}  // namespace crevice::cocos
