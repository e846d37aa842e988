// A recursive descent over the tokens of a whole-number expression.
#include "cocos/text/TextConstants.h"

#include <algorithm>
#include <charconv>

namespace crevice::cocos {

/// One expression. `steps` is shared by all names that it leads to, so that hostile macros end in bounded time.
class ConstantReader {
public:
    using Result = TextConstants::Result;

    ConstantReader(const TextConstants& constants, const GlslToken* begin, const GlslToken* end, int depth, int& steps)
        : constants_(constants), at_(begin), end_(end), depth_(depth), steps_(steps) {}

    /// A whole expression, after its macros of one value were put in their places.
    static std::optional<Result> evaluate(const TextConstants& constants, const GlslToken* begin, const GlslToken* end,
                                          int depth, int& steps) {
        std::vector<GlslToken> words;
        std::vector<std::string_view> open;
        bool certain = true;
        if (!expand(constants, begin, end, words, open, certain, steps)) return std::nullopt;
        auto result = ConstantReader(constants, words.data(), words.data() + words.size(), depth, steps).read();
        if (result) result->certain = result->certain && certain;
        return result;
    }

private:
    static constexpr int kMaxDepth = 32, kMaxSteps = 2000;
    static constexpr std::int64_t kLargest = 1ll << 40;

    static bool expand(const TextConstants& constants, const GlslToken* begin, const GlslToken* end,
                       std::vector<GlslToken>& words, std::vector<std::string_view>& open, bool& certain, int& steps) {
        for (; begin != end; ++begin) {
            if (++steps > kMaxSteps) return false;
            const auto known = constants.values_.find(begin->text);
            if (known == constants.values_.end() || known->second.size() != 1 || !known->second.front().macro ||
                constants.limits_.contains(begin->text)) {
                words.push_back(*begin);
                continue;
            }
            const auto& range = known->second.front();
            if (open.size() >= kMaxDepth || std::find(open.begin(), open.end(), begin->text) != open.end())
                return false;
            certain = certain && range.certain;
            open.push_back(begin->text);
            if (!expand(constants, range.begin, range.end, words, open, certain, steps)) return false;
            open.pop_back();
        }
        return true;
    }

    std::optional<Result> read() {
        if (at_ == end_) return std::nullopt;
        auto result = shift();
        return at_ == end_ ? result : std::nullopt;
    }

    std::optional<Result> shift() {
        auto left = sum();
        while (left && at_ != end_) {
            const bool up = take("<<") || takeTwo("<"), down = !up && (take(">>") || takeTwo(">"));
            if (!up && !down) break;
            const auto right = sum();
            if (!right || right->value < 0 || right->value > 40) return std::nullopt;
            const std::int64_t value =
                up ? multiply(left->value, std::int64_t{1} << right->value) : left->value >> right->value;
            left = limited({value, left->certain && right->certain});
        }
        return left;
    }

    bool takeTwo(std::string_view text) {
        if (end_ - at_ < 2 || at_[0].text != text || at_[1].text != text) return false;
        at_ += 2;
        return true;
    }

    bool take(std::string_view text) {
        if (at_ == end_ || at_->text != text) return false;
        ++at_;
        return true;
    }

    std::optional<Result> sum() {
        auto left = product();
        while (left && at_ != end_) {
            const bool plus = take("+"), minus = !plus && take("-");
            if (!plus && !minus) break;
            const auto right = product();
            if (!right) return std::nullopt;
            left = limited(
                {plus ? left->value + right->value : left->value - right->value, left->certain && right->certain});
        }
        return left;
    }

    std::optional<Result> product() {
        auto left = unary();
        while (left && at_ != end_) {
            const bool times = take("*"), by = !times && take("/"), rest = !times && !by && take("%");
            if (!times && !by && !rest) break;
            const auto right = unary();
            if (!right || (!times && right->value == 0)) return std::nullopt;
            const std::int64_t value = times ? multiply(left->value, right->value)
                                       : by  ? left->value / right->value
                                             : left->value % right->value;
            left = limited({value, left->certain && right->certain});
        }
        return left;
    }

    std::optional<Result> unary() {
        if (++depth_ > kMaxDepth || ++steps_ > kMaxSteps) return std::nullopt;
        const bool negative = take("-");
        auto result = negative ? unary() : primary();
        if (negative && result) result->value = -result->value;
        --depth_;
        return result;
    }

    std::optional<Result> primary() {
        if (at_ == end_) return std::nullopt;
        if (take("(")) {
            auto inner = shift();
            return take(")") ? inner : std::nullopt;
        }
        const GlslToken& token = *at_++;
        return token.isName() ? named(token.text) : number(token.text);
    }

    static std::optional<Result> number(std::string_view text) {
        if (!text.empty() && (text.back() == 'u' || text.back() == 'U')) text.remove_suffix(1);
        const bool hex = text.starts_with("0x") || text.starts_with("0X");
        if (hex) text.remove_prefix(2);
        Result result;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result.value, hex ? 16 : 10);
        if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
        return limited(result);
    }

    std::optional<Result> named(std::string_view name) {
        std::optional<Result> largest;
        if (const auto limit = constants_.limits_.find(name); limit != constants_.limits_.end())
            largest = Result{limit->second, false};
        const auto known = constants_.values_.find(name);
        if (known == constants_.values_.end()) return largest;
        for (const auto& range : known->second) {
            auto value = evaluate(constants_, range.begin, range.end, depth_ + 1, steps_);
            if (!value) return std::nullopt;
            value->certain = value->certain && range.certain;
            if (largest) {
                largest->certain = largest->certain && value->certain && largest->value == value->value;
                largest->value = std::max(largest->value, value->value);
            } else {
                largest = value;
            }
        }
        return largest;
    }

    static std::int64_t multiply(std::int64_t a, std::int64_t b) {
        const bool fits = a == 0 || (b <= kLargest / std::max<std::int64_t>(1, std::abs(a)) &&
                                     b >= -kLargest / std::max<std::int64_t>(1, std::abs(a)));
        return fits ? a * b : kLargest + 1;
    }

    static std::optional<Result> limited(Result result) {
        if (result.value > kLargest || result.value < -kLargest) return std::nullopt;
        return result;
    }

    const TextConstants& constants_;
    const GlslToken* at_;
    const GlslToken* end_;
    int depth_;
    int& steps_;
};

void TextConstants::addDefine(const std::vector<GlslToken>& tokens, std::size_t first, std::size_t end) {
    const std::size_t name = first + 2;
    if (name >= end || !tokens[name].isName()) return;
    const std::size_t value = name + 1;
    const std::string_view word = tokens[name].text;
    const bool function =
        value < end && tokens[value].text == "(" && tokens[value].text.data() == word.data() + word.size();
    const bool adjacent = tokens[first + 1].text.data() == tokens[first].text.data() + 1;
    if (!function) values_[word].push_back({tokens.data() + value, tokens.data() + end, adjacent, true});
}

void TextConstants::addText(const std::vector<GlslToken>& tokens) {
    for (std::size_t at = 0; at < tokens.size(); ++at) {
        if (tokens[at].directive) {
            const std::size_t end = directiveEnd(tokens, at);
            if (at + 1 < end && tokens[at + 1].text == "define") addDefine(tokens, at, end);
            at = end - 1;
        } else if (tokens[at].text == "const" && at + 4 < tokens.size() &&
                   (tokens[at + 1].text == "int" || tokens[at + 1].text == "uint") && tokens[at + 3].text == "=") {
            std::size_t end = at + 4;
            while (end < tokens.size() && tokens[end].text != ";" && !tokens[end].directive) ++end;
            values_[tokens[at + 2].text].push_back({tokens.data() + at + 4, tokens.data() + end, true, false});
            at = end - 1;
        }
    }
}

std::optional<TextConstants::Result> TextConstants::evaluate(const GlslToken* begin, const GlslToken* end) const {
    int steps = 0;
    return ConstantReader::evaluate(*this, begin, end, 0, steps);
}

}  // namespace crevice::cocos
