// Text of the console in lines of a given width.
#pragma once

#include <cstddef>
#include <string>

namespace shadowproof {

/// Lines longer than `columns` are broken at spaces. What follows is indented as far as the line's
/// last column of text begins (after two spaces or more), but to 30 at most; a word that does not
/// fit keeps its length.
std::string wrapped(const std::string& text, std::size_t columns);

} // namespace shadowproof
