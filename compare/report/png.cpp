#include "compare/report/png.h"

#include "scenes/error.h"

#include <fmt/format.h>
#include <png.h>

#include <cassert>
#include <cstdio>
#include <new>
#include <utility>

namespace shadowproof {

namespace {

/// A growing buffer that libpng writes to, as a stream of the C library.
class GrowingBytes {
public:
    GrowingBytes()
        : stream_(::fopencookie(
              this, "wb", {.read = nullptr, .write = &append, .seek = nullptr, .close = nullptr})) {
        if (stream_ == nullptr) throw std::bad_alloc();
    }
    ~GrowingBytes() {
        if (stream_ != nullptr) static_cast<void>(std::fclose(stream_));
    }
    GrowingBytes(const GrowingBytes&) = delete;
    GrowingBytes& operator=(const GrowingBytes&) = delete;

    std::FILE* stream() const { return stream_; }
    bool full() const { return full_; }
    /// All that was written; the stream is closed.
    std::string take() {
        const bool closed = std::fclose(std::exchange(stream_, nullptr)) == 0;
        if (full_ || !closed) throw std::bad_alloc();
        return std::move(bytes_);
    }

private:
    /// The C library calls this, which must not throw. 0: nothing was taken.
    static ssize_t append(void* cookie, const char* bytes, std::size_t count) noexcept {
        auto* const self = static_cast<GrowingBytes*>(cookie);
        try {
            self->bytes_.append(bytes, count);
            return static_cast<ssize_t>(count);
        } catch (const std::bad_alloc&) {
            self->full_ = true;
            return 0;
        }
    }

    std::string bytes_;
    bool full_ = false;
    std::FILE* stream_;
};

/// By libpng's simplified interface (libpng manual, section V): `colormap` null for gray.
std::string encoded(int width, int height, const void* pixels, png_uint_32 format,
                    const void* colormap, std::size_t colors) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = format;
    // These pictures have long runs: quick compression is small enough.
    image.flags = PNG_IMAGE_FLAG_FAST;
    image.colormap_entries = static_cast<png_uint_32>(colors);
    GrowingBytes bytes;
    if (png_image_write_to_stdio(&image, bytes.stream(), 0, pixels, 0, colormap) != 0)
        return bytes.take();
    const std::string reason = image.message;
    png_image_free(&image);
    if (bytes.full()) throw std::bad_alloc();
    throw Error(fmt::format("a picture of {}x{}", width, height),
                "cannot be made a PNG (" + reason + ")", "try a smaller --size");
}

} // namespace

std::string to_png(const Image<Visibility>& classes) {
    return encoded(classes.width, classes.height, classes.pixels.data(), PNG_FORMAT_GRAY, nullptr,
                   0);
}

std::string to_png(const Image<Rgb>& picture) {
    static_assert(sizeof(Rgb) == 3);
    return encoded(picture.width, picture.height, picture.pixels.data(), PNG_FORMAT_RGB, nullptr,
                   0);
}

std::string to_png(const PalettePicture& picture) {
    static_assert(sizeof(Rgb) == 3);
    assert(picture.palette.size() <= 256);
    return encoded(picture.indices.width, picture.indices.height, picture.indices.pixels.data(),
                   PNG_FORMAT_RGB_COLORMAP, picture.palette.data(), picture.palette.size());
}

std::optional<std::string> png_damage(std::string_view bytes, std::uint64_t width,
                                      std::uint64_t height) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0)
        return fmt::format("cannot be opened as a picture ({})", image.message);
    if (image.width != width || image.height != height) {
        png_image_free(&image);
        return fmt::format("is {}x{}, but the results say {}x{}", image.width, image.height, width,
                           height);
    }
    image.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
    // Warnings count as damage: a wrong checksum is one.
    png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr);
    if (image.warning_or_error == 0) return std::nullopt;
    return fmt::format("is damaged ({})", image.message);
}

} // namespace shadowproof
