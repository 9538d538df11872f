// Suggestions for misspelt words: the nearest known one.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drape {

/// Number of insertions, deletions, replacements and swaps of neighbours that turn a into b
/// (optimal string alignment distance).
int edit_distance(std::string_view a, std::string_view b);

/// The nearest of the known words, if it is near enough to be meant: at most a third of the longer
/// word is wrong (and always up to one letter in words of two letters or more).
std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& known);

}  // namespace drape
