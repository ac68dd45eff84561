// The name that a misspelt word probably means.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace shadowproof {

/// The name with the smallest edit distance from the word (letters inserted, left out, replaced, or
/// exchanged with their neighbour): at most one edit for each three of the word's letters. Empty
/// where there is none; the first of several that are equally near.
std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

/// " (did you mean NAME?)", or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

} // namespace shadowproof
