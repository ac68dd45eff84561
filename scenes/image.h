// A rectangle of values, one per pixel. Rows run from the top of the picture; the centre of pixel
// (x, y) is at (x + 0.5, y + 0.5), measured from the top left corner.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

namespace shadowproof {

template <class T>
struct Image {
    int width = 0;
    int height = 0;
    std::vector<T> pixels; ///< width * height values, row by row

    Image() = default;
    Image(int w, int h, T value = T{})
        : width(w), height(h),
          pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value) {}

    std::size_t index(int x, int y) const {
        assert(x >= 0 && x < width && y >= 0 && y < height);
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
    T& at(int x, int y) { return pixels[index(x, y)]; }
    const T& at(int x, int y) const { return pixels[index(x, y)]; }
};

/// A copy of a picture with each pixel converted.
template <class To, class From, class Convert>
Image<To> converted(const Image<From>& from, const Convert& convert) {
    Image<To> to(from.width, from.height);
    std::transform(from.pixels.begin(), from.pixels.end(), to.pixels.begin(), convert);
    return to;
}

} // namespace shadowproof
