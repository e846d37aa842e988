// A recursive-descent reader of preprocessor expressions (GLSL 4.50, section 3.3) over known and unknown values.
#include "cocos/Conditions.h"

#include <charconv>

#include "cocos/SourceText.h"

namespace crevice::cocos {
namespace {

constexpr int kMaxDepth = 200;
constexpr int kEquality = 6, kOrder = 7;  ///< Precedences of comparisons.
constexpr std::string_view kOperators[] = {"||", "&&", "==", "!=", "<=", ">=", "<<", ">>", "<", ">", "+", "-",
                                           "*",  "/",  "%",  "&",  "|",  "^",  "!",  "~",  "(", ")", ","};

int precedenceOf(std::string_view op) {
    if (op == "||") return 1;
    if (op == "&&") return 2;
    if (op == "|") return 3;
    if (op == "^") return 4;
    if (op == "&") return 5;
    if (op == "==" || op == "!=") return kEquality;
    if (op == "<" || op == ">" || op == "<=" || op == ">=") return kOrder;
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

void append(std::vector<std::string>& list, const std::vector<std::string>& more) {
    list.insert(list.end(), more.begin(), more.end());
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
        if (!failed_) result.compared = std::move(compared_);
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
        const std::string_view before = word_;
        Condition left = failed_ ? Condition{} : readUnary();
        while (!failed_) {
            const std::string_view op = word_;
            const int precedence = precedenceOf(op);
            if (precedence < level || precedence == 0) break;
            if (precedence == kEquality || precedence == kOrder) noteComparison(before, op);
            advance();
            left = combine(op, left, readBinary(precedence + 1));
        }
        --depth_;
        return left;
    }

    /// A name alone on the left of an operator, which is the present word, or on its right.
    void noteComparison(std::string_view left, std::string_view op) {
        const auto gap = [](const char* from, const char* to) {
            return trimBlank(std::string_view(from, static_cast<std::size_t>(to - from))).empty();
        };
        const std::string_view right = leadingName(trimBlank(text_));
        for (const std::string_view name : {left, right}) {
            if (leadingName(name).empty() || name == "defined" || name == "__VERSION__") continue;
            const bool alone = name.data() == right.data() || gap(name.data() + name.size(), op.data());
            if (alone && lookup_(name, true).outside) compared_.emplace_back(name);
        }
    }

    static Condition combine(std::string_view op, const Condition& a, const Condition& b) {
        if (op == "&&" || op == "||") return combineLogic(op == "&&", a, b);
        Condition result;
        if (a.value && b.value) {
            result.value = calculate(op, *a.value, *b.value);
            return result;
        }
        append(result.needs, a.needs);
        append(result.needs, b.needs);
        if (result.needs.size() == 1 && !result.needs[0].starts_with('!')) result.negated = {"!" + result.needs[0]};
        return result;
    }

    static Condition combineLogic(bool both, const Condition& a, const Condition& b) {
        for (const auto* pair : {&a, &b}) {
            if (!pair->value) continue;
            const bool holds = *pair->value != 0;
            if (holds != both) return constant(holds ? 1 : 0);
            return pair == &a ? b : a;
        }
        // De Morgan: the opposite of `!a || !b` is simple, and so is that of `a || b`.
        Condition result;
        append(both ? result.needs : result.negated, both ? a.needs : a.negated);
        append(both ? result.needs : result.negated, both ? b.needs : b.negated);
        return result;
    }

    Condition readUnary() {
        if (word_ == "!" || word_ == "-" || word_ == "+" || word_ == "~") {
            if (++depth_ > kMaxDepth) failed_ = tooDeep_ = true;
            const std::string_view op = word_;
            advance();
            Condition operand = failed_ ? Condition{} : readUnary();
            --depth_;
            if (op == "!") return negate(operand);
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
        const ConditionName name = failed_ ? ConditionName{} : lookup_(word_, false);
        if (name.outside && !failed_) {
            result.needs = {std::string(word_)};
            result.negated = {"!" + std::string(word_)};
        }
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
        if (name.value) return result;
        result.needs = name.alias;
        if (name.alias.empty() && name.outside) result.needs = {std::string(word)};
        if (result.needs.size() == 1) result.negated = {"!" + result.needs[0]};
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
    std::vector<std::string> compared_;
};

}  // namespace

Condition readCondition(std::string_view expression, const NameLookup& lookup) {
    return Reader(expression, lookup).run();
}

Condition negate(const Condition& condition) {
    Condition result;
    if (condition.value) result.value = *condition.value == 0 ? 1 : 0;
    result.needs = condition.negated;
    // What negates back to one name is that name.
    if (condition.needs.size() == 1) result.negated = condition.needs;
    return result;
}

std::optional<bool> decideByVersion(std::string_view expression) {
    const auto value = readCondition(expression, [](std::string_view, bool) { return ConditionName{}; }).value;
    if (!value) return std::nullopt;
    return *value != 0;
}

}  // namespace crevice::cocos
