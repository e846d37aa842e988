// Limits from and to text.
#include "core/Limits.h"

#include <charconv>
#include <limits>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "core/Error.h"
#include "core/Text.h"

namespace crevice {
namespace {

constexpr std::string_view kSuffixes = "KMG";

std::uint64_t stepOf(std::string_view unit) { return unit == "bytes" ? 1024 : 1000; }

/// Nothing unless the text is a whole number from 1, perhaps with a suffix.
std::uint64_t readNumber(std::string_view text, std::string_view unit) {
    std::uint64_t factor = 1;
    const std::size_t suffix = text.empty() ? std::string_view::npos : kSuffixes.find(text.back());
    if (suffix != std::string_view::npos) {
        for (std::size_t i = 0; i <= suffix; ++i) factor *= stepOf(unit);
        text.remove_suffix(1);
    }
    std::uint64_t number = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (code != std::errc() || end != text.data() + text.size()) return 0;
    return number <= std::numeric_limits<std::uint64_t>::max() / factor ? number * factor : 0;
}

}  // namespace

void setLimit(Limits& limits, std::string_view text) {
    const std::string_view name = text.substr(0, text.find('='));
    const std::string_view value = name.size() < text.size() ? text.substr(name.size() + 1) : "";
    std::vector<std::string> names;
    bool known = false;
    visitLimits(limits, [&](auto& field, const LimitInfo& info) {
        names.emplace_back(info.name);
        if (name != info.name) return;
        known = true;
        using Field = std::remove_reference_t<decltype(field)>;
        const std::uint64_t number = readNumber(value, info.unit);
        // A part of the range of the type: sums and small multiples of a limit must not overflow.
        const std::uint64_t most = static_cast<std::uint64_t>(std::numeric_limits<Field>::max()) / 16;
        if (number < 1 || number > most) {
            throw Error(fmt::format("--limit {}: '{}' is not a whole number from 1 to {}", name, value, most),
                        fmt::format("write {}, in {}: --limit {}={}", info.name, info.unit, info.name,
                                    limitText(static_cast<std::size_t>(field), info.unit)));
        }
        field = static_cast<Field>(number);
    });
    if (!known) throw Error(fmt::format("no limit named '{}'", name), didYouMean(name, names, "limits"));
}

std::string limitText(std::size_t value, std::string_view unit) {
    std::string suffix;
    for (const char letter : kSuffixes) {
        if (value == 0 || value % stepOf(unit) != 0) break;
        value /= stepOf(unit);
        suffix = letter;
    }
    return std::to_string(value) + suffix;
}

std::string raiseLimit(std::string_view name) {
    return fmt::format("raise it with --limit {}=N if you trust the file", name);
}

}  // namespace crevice
