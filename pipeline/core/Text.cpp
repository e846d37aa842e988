// Near names, for messages that suggest what was meant: by edit distance, else by how they begin.
#include "core/Text.h"

#include <algorithm>
#include <cstddef>

namespace crevice {
namespace {

constexpr std::size_t kMaxNameLength = 100;  // longer names are not misspelt words
constexpr std::size_t kMaxListedNames = 60;
constexpr std::size_t kLeastBeginning = 3;  // fewer letters begin too many names

/// Insertions, deletions, replacements and swaps of neighbours that turn one word into the other
/// (optimal string alignment; Wagner and Fischer 1974 with the transposition of Damerau 1964).
std::size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> beforeLast(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) row[j] = std::min(row[j], beforeLast[j - 2] + 1);
        }
        std::swap(beforeLast, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

std::string quotedAlternatives(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
        text += "'" + names[i] + "'";
    }
    return text;
}

}  // namespace

std::vector<std::string> nearestNames(std::string_view name, const std::vector<std::string>& candidates,
                                      std::size_t limit) {
    if (name.empty() || name.size() > kMaxNameLength) return {};
    const std::size_t allowed = std::max<std::size_t>(2, name.size() / 3);
    const std::string wanted = lowerCase(name);
    std::vector<std::pair<std::size_t, const std::string*>> near;
    for (const std::string& candidate : candidates) {
        const std::size_t longer = std::max(candidate.size(), name.size());
        const std::size_t shorter = std::min(candidate.size(), name.size());
        if (longer - shorter > allowed) continue;
        const std::size_t distance = editDistance(wanted, lowerCase(candidate));
        const bool sharesLetters = distance < longer;
        if (distance <= allowed && sharesLetters) near.emplace_back(distance, &candidate);
    }
    if (near.empty() && wanted.size() >= kLeastBeginning) {
        for (const std::string& candidate : candidates)
            if (lowerCase(candidate).starts_with(wanted)) near.emplace_back(0, &candidate);
    }
    std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string> names;
    for (std::size_t i = 0; i < near.size() && i < limit; ++i) names.push_back(*near[i].second);
    return names;
}

std::string didYouMean(std::string_view name, const std::vector<std::string>& candidates, std::string_view what) {
    if (candidates.empty()) return "there are no " + std::string(what) + " to choose from";
    const std::vector<std::string> near = nearestNames(name, candidates);
    std::string text;
    if (!near.empty()) text = "did you mean " + quotedAlternatives(near) + "? ";
    text += std::string(what) + ": ";
    if (candidates.size() <= kMaxListedNames) return text + join(candidates);
    const auto cut = candidates.begin() + static_cast<std::ptrdiff_t>(kMaxListedNames);
    return text + join({candidates.begin(), cut}) + ", … (" + std::to_string(candidates.size() - kMaxListedNames) +
           " more)";
}

std::string lowerCase(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return lower;
}

std::string join(const std::vector<std::string>& words, std::string_view separator) {
    std::string text;
    for (const std::string& word : words) {
        if (&word != &words.front()) text += separator;
        text += word;
    }
    return text;
}

}  // namespace crevice
