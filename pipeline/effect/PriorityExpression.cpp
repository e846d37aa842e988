// Evaluates priorities by recursive descent.
#include "effect/PriorityExpression.h"

#include <cctype>
#include <charconv>
#include <cmath>

namespace crevice {
namespace {

constexpr int kMaxDepth = 50;

class Reader {
public:
    explicit Reader(std::string_view text) : text_(text) {}

    std::optional<double> run() {
        const std::optional<double> value = sum();
        skipBlanks();
        return text_.empty() ? value : std::nullopt;
    }

private:
    void skipBlanks() {
        while (!text_.empty() && std::isspace(static_cast<unsigned char>(text_.front())) != 0) text_.remove_prefix(1);
    }

    bool take(char c) {
        skipBlanks();
        if (!text_.starts_with(c)) return false;
        text_.remove_prefix(1);
        return true;
    }

    std::optional<double> sum() {
        std::optional<double> value = product();
        while (value) {
            const bool plus = take('+');
            if (!plus && !take('-')) break;
            const std::optional<double> next = product();
            if (!next) return std::nullopt;
            *value += plus ? *next : -*next;
        }
        return value;
    }

    std::optional<double> product() {
        std::optional<double> value = factor();
        while (value) {
            const bool times = take('*');
            if (!times && !take('/')) break;
            const std::optional<double> next = factor();
            if (!next || (!times && *next == 0)) return std::nullopt;
            *value = times ? *value * *next : *value / *next;
        }
        return value;
    }

    std::optional<double> factor() {
        if (++depth_ > kMaxDepth) return std::nullopt;
        std::optional<double> value;
        if (take('-')) {
            value = factor();
            if (value) *value = -*value;
        } else if (take('(')) {
            value = sum();
            if (!take(')')) value.reset();
        } else {
            value = leaf();
        }
        --depth_;
        return value;
    }

    std::optional<double> leaf() {
        skipBlanks();
        for (const auto& [name, known] : {std::pair("min", 0.0), {"max", 255.0}, {"default", 128.0}}) {
            const std::string_view word(name);
            if (!text_.starts_with(word)) continue;
            text_.remove_prefix(word.size());
            return known;
        }
        double number = 0;
        const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), number);
        if (error != std::errc{} || !std::isfinite(number)) return std::nullopt;
        text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
        return number;
    }

    std::string_view text_;
    int depth_ = 0;
};

}  // namespace

std::optional<int> evaluatePriority(std::string_view expression) {
    const std::optional<double> value = Reader(expression).run();
    if (!value || std::abs(*value) > 1e6) return std::nullopt;
    return static_cast<int>(std::lround(*value));
}

}  // namespace crevice
