// What a word that is not known may have been meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace shadowproof {

/// The name that a word becomes by the fewest letters put in, left out, replaced or exchanged with
/// their neighbour: at most one for each three of the word's letters. Empty where there is none;
/// of several that are as near, the first.
std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

/// " (did you mean NAME?)", or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

} // namespace shadowproof
