#include "compare/report/png.h"

#include <fmt/format.h>
#include <libdeflate.h>
#include <png.h>

#include <algorithm>
#include <cassert>
#include <memory>
#include <new>

namespace shadowproof {

namespace {

/// A hundredth larger than by the highest level, in a quarter of the time.
constexpr int compression_level = 9;

struct FreeCompressor {
    void operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }
};

void append_number(std::string& bytes, std::size_t number) {
    for (unsigned shift = 32; shift > 0;)
        bytes += static_cast<char>(number >> (shift -= 8) & 0xffU);
}

/// Length, type, content and checksum (PNG specification, section 5.3).
void append_chunk(std::string& bytes, std::string_view type, std::string_view content) {
    append_number(bytes, content.size());
    const std::size_t begin = bytes.size();
    bytes += type;
    bytes += content;
    append_number(bytes, libdeflate_crc32(0, bytes.data() + begin, bytes.size() - begin));
}

std::string zlib_stream(std::string_view bytes) {
    const std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor(
        libdeflate_alloc_compressor(compression_level));
    if (!compressor) throw std::bad_alloc();
    std::string stream(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), 0);
    stream.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(),
                                           stream.data(), stream.size()));
    return stream;
}

enum class ColorType : char { gray = 0, rgb = 2, palette = 3 }; ///< as the specification has them

/// libpng has another compressor, whose files of these pictures are larger and take longer. Rows
/// are not filtered but those of colours, which are stored as differences to the pixel before.
std::string encoded(int width, int height, std::string_view pixels, ColorType type, int depth,
                    std::string_view palette, Memo* memo) {
    const std::size_t row = pixels.size() / static_cast<std::size_t>(std::max(height, 1));
    const bool differences = type == ColorType::rgb;
    std::string rows;
    rows.reserve(pixels.size() + static_cast<std::size_t>(height));
    for (std::size_t begin = 0; begin < pixels.size(); begin += row) {
        rows += static_cast<char>(differences ? 1 : 0);
        const std::size_t written = rows.size();
        rows += pixels.substr(begin, row);
        if (!differences) continue;
        for (std::size_t i = row - 1; i >= 3; --i)
            rows[written + i] = static_cast<char>(rows[written + i] - rows[written + i - 3]);
    }
    std::string header;
    append_number(header, static_cast<std::size_t>(width));
    append_number(header, static_cast<std::size_t>(height));
    header += {static_cast<char>(depth), static_cast<char>(type), 0, 0, 0};
    std::string bytes = "\x89PNG\r\n\x1a\n";
    append_chunk(bytes, "IHDR", header);
    if (!palette.empty()) append_chunk(bytes, "PLTE", palette);
    append_chunk(bytes, "IDAT",
                 remembered(memo, {bytes_for_memo(rows)}, [&] { return zlib_stream(rows); }));
    append_chunk(bytes, "IEND", {});
    return bytes;
}

/// The bytes of a list, one after the other.
template <class T>
std::string_view bytes_of(const std::vector<T>& list) {
    return {reinterpret_cast<const char*>(list.data()), list.size() * sizeof(T)};
}

/// The same picture with only those colours that are there, in their order.
PalettePicture with_used_colors(const PalettePicture& picture) {
    std::array<int, 256> place{};
    for (const std::uint8_t index : picture.indices.pixels) place[index] = 1;
    PalettePicture used;
    for (std::size_t i = 0; i < picture.palette.size(); ++i) {
        if (place[i] == 0) continue;
        place[i] = static_cast<int>(used.palette.size());
        used.palette.push_back(picture.palette[i]);
    }
    used.indices = converted<std::uint8_t>(picture.indices, [&](std::uint8_t index) {
        return static_cast<std::uint8_t>(place[index]);
    });
    return used;
}

/// Bits of a pixel that tell so many colours apart, of those that a PNG may have.
int bits_for(std::size_t colors) {
    return colors <= 2 ? 1 : colors <= 4 ? 2 : colors <= 16 ? 4 : 8;
}

/// Rows of pixels of `depth` bits each, the first in a byte's highest; each row begins a byte.
std::string packed_rows(const Image<std::uint8_t>& indices, int depth) {
    std::string rows;
    for (int y = 0; y < indices.height; ++y)
        for (int x = 0; x < indices.width;) {
            int byte = 0;
            for (int left = 8; left > 0; ++x) {
                left -= depth;
                if (x < indices.width) byte |= indices.at(x, y) << left;
            }
            rows += static_cast<char>(byte);
        }
    return rows;
}

} // namespace

std::string to_png(const Image<Visibility>& classes, Memo* memo) {
    return encoded(classes.width, classes.height, bytes_of(classes.pixels), ColorType::gray, 8, {},
                   memo);
}

std::string to_png(const Image<Rgb>& picture) {
    static_assert(sizeof(Rgb) == 3);
    return encoded(picture.width, picture.height, bytes_of(picture.pixels), ColorType::rgb, 8, {},
                   nullptr);
}

std::string to_png(const PalettePicture& picture, Memo* memo) {
    static_assert(sizeof(Rgb) == 3);
    assert(picture.palette.size() <= 256);
    const PalettePicture used = with_used_colors(picture);
    const int depth = bits_for(used.palette.size());
    return encoded(used.indices.width, used.indices.height, packed_rows(used.indices, depth),
                   ColorType::palette, depth, bytes_of(used.palette), memo);
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
