// Pictures and lists of whole numbers in few bytes: each value is guessed from those before it and
// beside it, and what is coded is whether the guess is right. compare/viewer/coded.js reads them.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace shadowproof {

using Numbers = std::span<const std::uint32_t>;

/// A picture of areas that are of one value each, `width` to a row: classes, counters, triangles.
/// Guessed is one of the values around a pixel, or the `guide`'s at the same pixel; a guide is a
/// picture of the same size, or empty. Its edges are learned from, too. One bit says of up to
/// sixteen pixels of a row, below the first, that they have the one value of all coded pixels that
/// touch them, where the guide is even there, too. If `mask` is not empty, only pixels where it is
/// not 0 have a value, which `values` lists in rows from the top; then there is no such bit.
std::string coded_areas(Numbers values, std::uint32_t width, Numbers guide, Numbers mask);

/// A picture of shades that change little by little, with `channels` bytes for each pixel. Guessed
/// is that a pixel changes like those around it, or differs from the `guide` as they do.
std::string coded_shades(Numbers values, std::uint32_t width, std::uint32_t channels,
                         Numbers guide);

/// Rows of `columns` numbers each. Guessed is what followed the same one or two numbers before in
/// their column.
std::string coded_sequence(Numbers values, std::uint32_t columns);

/// Rows of numbers that are not 0, with a 0 behind each. A row is coded as what makes it of the row
/// before: where numbers give way to others. Guessed is what stood for the same number last, or
/// else, as in a sequence, what followed the same numbers.
std::string coded_rows(Numbers values);

} // namespace shadowproof
