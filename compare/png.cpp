#include "compare/png.h"

#include "scenes/error.h"

#include <fmt/format.h>
#include <png.h>

#include <cassert>

namespace shadowproof {

namespace {

/// By libpng's simplified interface (libpng manual, section V): `colormap` null for gray.
/// Errors name `named`.
void write(const std::filesystem::path& file, const std::filesystem::path& named, int width,
           int height, const void* bytes, png_uint_32 format, const void* colormap,
           std::size_t colors) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = format;
    // These pictures are long runs: the quick compression is as small as need be.
    image.flags = PNG_IMAGE_FLAG_FAST;
    image.colormap_entries = static_cast<png_uint_32>(colors);
    if (png_image_write_to_file(&image, file.c_str(), 0, bytes, 0, colormap) != 0) return;
    const std::string reason = image.message;
    png_image_free(&image);
    throw Error(named.string(), "the picture cannot be written (" + reason + ")",
                "see that its folder is writable and has room");
}

} // namespace

void write_png(const std::filesystem::path& file, const Image<Visibility>& classes,
               const std::filesystem::path& named) {
    write(file, named.empty() ? file : named, classes.width, classes.height, classes.pixels.data(),
          PNG_FORMAT_GRAY, nullptr, 0);
}

void write_png(const std::filesystem::path& file, const Image<Rgb>& picture,
               const std::filesystem::path& named) {
    static_assert(sizeof(Rgb) == 3);
    write(file, named.empty() ? file : named, picture.width, picture.height, picture.pixels.data(),
          PNG_FORMAT_RGB, nullptr, 0);
}

void write_png(const std::filesystem::path& file, const PalettePicture& picture) {
    static_assert(sizeof(Rgb) == 3);
    assert(picture.palette.size() <= 256);
    write(file, file, picture.indices.width, picture.indices.height, picture.indices.pixels.data(),
          PNG_FORMAT_RGB_COLORMAP, picture.palette.data(), picture.palette.size());
}

std::optional<std::string> png_damage(const std::filesystem::path& file, std::uint64_t width,
                                      std::uint64_t height) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&image, file.c_str()) == 0)
        return fmt::format("cannot be opened as a picture ({})", image.message);
    if (image.width != width || image.height != height) {
        png_image_free(&image);
        return fmt::format("is {}x{}, but the results say {}x{}", image.width, image.height, width,
                           height);
    }
    image.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
    // A warning is a damage too: a checksum that is wrong is one.
    png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr);
    if (image.warning_or_error == 0) return std::nullopt;
    return fmt::format("is damaged ({})", image.message);
}

} // namespace shadowproof
