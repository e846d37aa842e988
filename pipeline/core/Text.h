// Small words about words: near names for "did you mean", quoting, lists.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace crevice {

/// Candidates whose edit distance to `name` is at most a third of its length (at least 2), nearest first, else those
/// that begin with it; at most `limit`.
std::vector<std::string> nearestNames(std::string_view name, const std::vector<std::string>& candidates,
                                      std::size_t limit = 3);

/// "did you mean 'format'? keys: a, b, c", or "keys: a, b, c" when nothing is near. `what` is the plural of the things
/// listed.
std::string didYouMean(std::string_view name, const std::vector<std::string>& candidates, std::string_view what);

/// With the letters A to Z small; others as they are, whatever the locale.
std::string lowerCase(std::string_view text);

/// "a, b, c".
std::string join(const std::vector<std::string>& words, std::string_view separator = ", ");

}  // namespace crevice
