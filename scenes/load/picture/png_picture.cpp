#include "scenes/load/picture/png_picture.h"

#include "scenes/error.h"

#include <fmt/format.h>
#include <png.h>

#include <array>
#include <bit>
#include <cassert>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>

namespace shadowproof {

namespace {

using Bytes = std::span<const unsigned char>;

/// What libpng's callbacks see.
struct Reading {
    Bytes rest;
    std::array<char, 128> message{};
};

/// libpng's own handler would print the message.
[[noreturn]] void on_error(png_structp png, png_const_charp message) {
    auto& reading = *static_cast<Reading*>(png_get_error_ptr(png));
    std::snprintf(reading.message.data(), reading.message.size(), "%s", message);
    png_longjmp(png, 1);
}

/// Ignores what libpng repaired or skipped: the values are there.
void on_warning(png_structp /*png*/, png_const_charp /*message*/) {}

void read_bytes(png_structp png, png_bytep to, std::size_t size) {
    auto& reading = *static_cast<Reading*>(png_get_io_ptr(png));
    if (size > reading.rest.size()) png_error(png, "it ends too early");
    std::memcpy(to, reading.rest.data(), size);
    reading.rest = reading.rest.subspan(size);
}

/// libpng's two structures.
class Handle {
public:
    explicit Handle(Reading& reading)
        : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &reading, on_error, on_warning)),
          info_(png_ != nullptr ? png_create_info_struct(png_) : nullptr) {}
    ~Handle() { png_destroy_read_struct(&png_, &info_, nullptr); }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;

    png_structp png() const { return png_; }
    png_infop info() const { return info_; }

private:
    png_structp png_;
    png_infop info_;
};

/// False where libpng calls on_error, which jumps back here: `work` may hold nothing that needs to
/// be destroyed.
template <class Work>
bool succeeds(png_structp png, const Work& work) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    work();
    return true;
}

/// Reads up to the first row; no memory is taken for rows yet.
void read_head(const Handle& handle, Reading& reading) {
    png_structp png = handle.png();
    png_set_read_fn(png, &reading, read_bytes);
    // Text, profiles, times and the like; not what changes pixels.
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_read_info(png, handle.info());
}

/// The format of a pixel in the rows, after start_rows is called.
struct PixelFormat {
    std::uint32_t channels = 0;
    std::uint32_t bytes = 0; ///< of a channel
};

/// Palettes become colours, transparent colours an alpha channel, and channels of less than a byte
/// become one byte each.
PixelFormat expanded(const Handle& handle) {
    const auto type = png_get_color_type(handle.png(), handle.info());
    std::uint32_t channels = (type & PNG_COLOR_MASK_COLOR) != 0 ? 3 : 1;
    const bool has_alpha = (type & PNG_COLOR_MASK_ALPHA) != 0 ||
                           png_get_valid(handle.png(), handle.info(), PNG_INFO_tRNS) != 0;
    if (has_alpha) ++channels;
    return {channels, png_get_bit_depth(handle.png(), handle.info()) == 16 ? 2U : 1U};
}

/// libpng allocates its own rows here.
void start_rows(const Handle& handle) {
    png_structp png = handle.png();
    png_set_expand(png);
    if constexpr (std::endian::native == std::endian::little) png_set_swap(png);
    png_set_interlace_handling(png);
    png_read_update_info(png, handle.info());
}

/// Divided by the largest of its type, in double, rounded once.
template <class T>
void append(const png_byte* row, std::size_t count, std::vector<float>& values) {
    for (std::size_t i = 0; i < count; ++i) {
        T value{};
        std::memcpy(&value, row + i * sizeof(T), sizeof(T));
        values.push_back(
            static_cast<float>(value / static_cast<double>(std::numeric_limits<T>::max())));
    }
}

/// libpng's own rows: the one it reads and the one before.
constexpr std::uint64_t rows_of_libpng = 2;

} // namespace

void require_room(std::uint64_t width, std::uint64_t height, std::uint64_t channels,
                  std::uint64_t stored, const std::string& where, const PictureRoom& room) {
    if (width < 1 || height < 1 || channels < 1)
        throw Error(where, "is a picture without pixels", "name another");
    const std::uint64_t pixels = width * height; // below 2^31 each
    // More channels than four cost time just as more pixels do.
    if (pixels > room.most_pixels || pixels * ((channels + 3) / 4) > room.most_pixels)
        throw Error(where,
                    fmt::format("is a picture of {}x{} pixels, more than {} altogether", width,
                                height, room.most_pixels),
                    "scale it down");
    room.memory.require(
        {pixels * (channels * sizeof(float) + room.bytes_made_of_pixel) + stored, where,
         fmt::format("its {}x{} pixels of {} channels", width, height, channels), "scale it down"});
}

Picture decode_png(Bytes bytes, const std::string& where, const PictureRoom& room) {
    Reading reading{bytes, {}};
    const Handle handle(reading);
    const auto refuse = [&] {
        throw Error(where, fmt::format("is damaged ({})", reading.message.data()),
                    "export the picture again");
    };
    if (handle.info() == nullptr) throw std::bad_alloc();
    png_structp png = handle.png();
    if (!succeeds(png, [&] { read_head(handle, reading); })) refuse();
    const std::uint32_t width = png_get_image_width(png, handle.info());
    const std::uint32_t height = png_get_image_height(png, handle.info());
    const auto [channels, channel_bytes] = expanded(handle);
    const std::uint64_t row_bytes = std::uint64_t{width} * channels * channel_bytes;
    const bool is_interlaced = png_get_interlace_type(png, handle.info()) != PNG_INTERLACE_NONE;
    const std::size_t rows = is_interlaced ? height : 1; // an interlaced one needs all of them
    require_room(width, height, channels, (rows + rows_of_libpng) * row_bytes, where, room);
    if (!succeeds(png, [&] { start_rows(handle); })) refuse();
    assert(png_get_rowbytes(png, handle.info()) == row_bytes);
    Picture picture{static_cast<int>(width),
                    static_cast<int>(height),
                    static_cast<int>(channels),
                    png_get_bit_depth(png, handle.info()),
                    {}};

    std::vector<png_byte> stored(rows * row_bytes);
    std::vector<png_bytep> places(rows);
    for (std::size_t y = 0; y < rows; ++y) places[y] = stored.data() + y * row_bytes;
    if (is_interlaced && !succeeds(png, [&] { png_read_image(png, places.data()); })) refuse();
    picture.values.reserve(channels * width * height);
    for (std::size_t y = 0; y < height; ++y) {
        if (!is_interlaced && !succeeds(png, [&] { png_read_row(png, places[0], nullptr); }))
            refuse();
        const png_byte* row = places[is_interlaced ? y : 0];
        if (picture.bits == 16)
            append<std::uint16_t>(row, channels * width, picture.values);
        else
            append<std::uint8_t>(row, channels * width, picture.values);
    }
    return picture;
}

} // namespace shadowproof
