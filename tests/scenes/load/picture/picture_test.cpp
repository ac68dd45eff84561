#include "scenes/error.h"
#include "scenes/load/picture/encode_picture.h"
#include "scenes/load/picture/picture.h"
#include "tests/scenes/small_gltf.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <libdeflate.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

namespace shadowproof::test {
namespace {

constexpr int width = 13;
constexpr int height = 9;

const MemoryAccount unlimited;

PictureRoom room(const MemoryAccount& memory = unlimited) {
    return {.memory = memory, .most_pixels = 1U << 20U};
}

/// Written by libpng; some values of every channel, rows packed as its type has them.
FileBytes png_of(int color, int bits, int interlace, bool transparent) {
    FileBytes bytes;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(
        png, &bytes,
        [](png_structp from, png_bytep data, std::size_t size) {
            auto& to = *static_cast<FileBytes*>(png_get_io_ptr(from));
            to.insert(to.end(), data, data + size);
        },
        nullptr);
    png_set_IHDR(png, info, width, height, bits, color, interlace, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    std::array<png_color, 4> palette{{{1, 2, 3}, {40, 50, 60}, {255, 0, 128}, {7, 8, 9}}};
    std::array<png_byte, 2> alphas{100, 200};
    png_color_16 gray{};
    gray.gray = gray.red = gray.green = gray.blue = 1;
    if (color == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette.data(), 4);
    if (transparent && color == PNG_COLOR_TYPE_PALETTE)
        png_set_tRNS(png, info, alphas.data(), 2, nullptr);
    else if (transparent)
        png_set_tRNS(png, info, nullptr, 0, &gray);
    png_write_info(png, info);
    const std::size_t row = png_get_rowbytes(png, info);
    FileBytes stored(row * height);
    for (std::size_t i = 0; i < stored.size(); ++i)
        stored[i] = static_cast<std::uint8_t>(i * i * 37 + i);
    if (color == PNG_COLOR_TYPE_PALETTE && bits == 8)
        for (std::uint8_t& value : stored) value = value % 4;
    std::vector<png_bytep> rows;
    for (std::size_t y = 0; y < height; ++y) rows.push_back(stored.data() + y * row);
    png_write_image(png, rows.data());
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    return bytes;
}

/// The same by OpenImageIO, from a file.
std::vector<float> by_openimageio(const FileBytes& bytes, int& channels) {
    const Folder folder;
    write_bytes(folder.path() / "a.png", bytes);
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open((folder.path() / "a.png").string(), &config);
    channels = input->spec().nchannels;
    std::vector<float> values(static_cast<std::size_t>(width * height * channels));
    input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, values.data());
    return values;
}

TEST(pictures, of_every_kind_of_png_have_the_values_that_another_reader_finds) {
    struct Kind {
        int color;
        std::vector<int> bits;
    };
    for (const Kind& kind :
         {Kind{PNG_COLOR_TYPE_GRAY, {1, 2, 4, 8, 16}}, Kind{PNG_COLOR_TYPE_PALETTE, {2, 8}},
          Kind{PNG_COLOR_TYPE_GRAY_ALPHA, {8, 16}}, Kind{PNG_COLOR_TYPE_RGB, {8, 16}},
          Kind{PNG_COLOR_TYPE_RGB_ALPHA, {8, 16}}})
        for (const int bits : kind.bits)
            for (const int interlace : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7})
                for (const bool transparent : {false, true}) {
                    if (transparent && (kind.color & PNG_COLOR_MASK_ALPHA) != 0) continue;
                    SCOPED_TRACE(testing::Message() << kind.color << ' ' << bits << ' ' << interlace
                                                    << ' ' << transparent);
                    const FileBytes bytes = png_of(kind.color, bits, interlace, transparent);
                    const Picture picture = decode_picture(bytes, "a.png", room());
                    int channels = 0;
                    const std::vector<float> expected = by_openimageio(bytes, channels);
                    ASSERT_EQ(picture.channels, channels);
                    EXPECT_EQ(picture.width, width);
                    EXPECT_EQ(picture.height, height);
                    EXPECT_EQ(picture.bits, bits == 16 ? 16 : 8);
                    ASSERT_EQ(picture.values.size(), expected.size());
                    for (std::size_t i = 0; i < expected.size(); ++i)
                        EXPECT_NEAR(picture.values[i], expected[i], 1e-7) << i;
                }
}

TEST(pictures, are_refused_before_they_are_decoded_where_they_do_not_fit) {
    const FileBytes bytes = png_of(PNG_COLOR_TYPE_RGB, 8, PNG_INTERLACE_NONE, false);
    // A row as stored, and two of libpng's own.
    const std::uint64_t decoded = 3 * sizeof(float) * width * height + 3 * 3 * width;
    EXPECT_NO_THROW(
        decode_picture(bytes, "a", room(MemoryAccount({program_bytes + decoded, "test"}))));
    EXPECT_THROW(
        decode_picture(bytes, "a", room(MemoryAccount({program_bytes + decoded - 1, "test"}))),
        Error);
}

TEST(pictures, in_png_take_nothing_for_rows_before_they_are_known_to_fit) {
    FileBytes wide = png_of(PNG_COLOR_TYPE_RGB_ALPHA, 16, PNG_INTERLACE_NONE, false);
    // The width stands behind the signature, a length and a name; the head's checksum behind it.
    constexpr std::size_t head = 12; // IHDR's name
    const std::array<std::uint8_t, 4> most{0x00, 0x0f, 0x42, 0x3f};
    std::copy(most.begin(), most.end(), wide.begin() + head + 4);
    const auto sum = libdeflate_crc32(0, wide.data() + head, 4 + 13);
    for (std::size_t i = 0; i < 4; ++i)
        wide[head + 4 + 13 + i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
    // Its rows alone would be 8 MB each.
    const MemoryAccount few_rows({program_bytes + 1'000'000, "test"});
    const PictureRoom any_size{.memory = few_rows, .most_pixels = std::uint64_t{1} << 30U};
    try {
        decode_picture(wide, "a", any_size);
        FAIL() << "read";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("999999x9 pixels of 4 channels"),
                  std::string::npos)
            << error.what();
    }
}

/// What reading it says; empty where it is read.
std::string refusal_of(const FileBytes& bytes) {
    const Folder folder;
    write_bytes(folder.path() / "a", bytes);
    try {
        read_picture(folder.path() / "a", room());
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

FileBytes written_by_openimageio(const std::string& name, const OIIO::ImageSpec& spec) {
    const Folder folder;
    const std::string file = (folder.path() / name).string();
    const std::vector<float> values(
        static_cast<std::size_t>(spec.width * spec.height * spec.nchannels), 0.5F);
    const auto output = OIIO::ImageOutput::create(file);
    output->open(file, spec);
    output->write_image(OIIO::TypeDesc::FLOAT, values.data());
    output->close();
    return bytes_of(file);
}

/// All channels of what `layout` and `pixels` are encoded as, read by OpenImageIO in their own
/// types.
template <class Pixel>
std::vector<Pixel> read_back(const PictureLayout& layout, const std::vector<Pixel>& pixels,
                             OIIO::ImageSpec& spec) {
    const Folder folder;
    const bool is_png = layout.format == PictureLayout::Format::png;
    const std::string file = (folder.path() / (is_png ? "a.png" : "a.exr")).string();
    const std::string bytes = encode_picture(layout, pixels.data(), file);
    write_bytes(file, {bytes.begin(), bytes.end()});
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open(file, &config);
    spec = input->spec();
    std::vector<Pixel> values(pixels.size());
    input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UNKNOWN, values.data());
    return values;
}

TEST(pictures, that_are_encoded_have_the_values_that_another_reader_finds) {
    using Format = PictureLayout::Format;
    using Type = PictureLayout::Type;
    OIIO::ImageSpec spec;

    struct Mixed {
        float a;
        std::uint32_t b;
        float c;
        bool operator==(const Mixed&) const = default;
    };
    const std::vector<Mixed> mixed{{1.5F, 7, -0.25F}, {1e30F, 0xffffffffU, 3}};
    EXPECT_EQ(read_back({.format = Format::openexr,
                         .width = 2,
                         .height = 1,
                         .channels = {{"m"}, {"n", Type::u32}, {"o"}}},
                        mixed, spec),
              mixed);
    EXPECT_EQ(spec.channelnames, (std::vector<std::string>{"m", "n", "o"}));

    const auto rgba = [](Type type) {
        return std::vector<PictureLayout::Channel>{
            {"R", type}, {"G", type}, {"B", type}, {"A", type}};
    };
    // Colours above their alpha would be cut off if it were taken for coverage.
    const std::vector<std::uint8_t> bytes{200, 100, 0, 50, 1, 2, 3, 0};
    EXPECT_EQ(read_back({Format::png, 2, 1, rgba(Type::u8)}, bytes, spec), bytes);
    const std::vector<std::uint16_t> words{60000, 300, 0, 5, 1, 2, 3, 65535};
    EXPECT_EQ(read_back({Format::png, 1, 2, rgba(Type::u16)}, words, spec), words);
    const std::vector<float> floats{2, 0.5F, 0.25F, 0.125F, -1, 0, 1, 1};
    EXPECT_EQ(read_back({Format::openexr, 2, 1, rgba(Type::f32)}, floats, spec), floats);
}

TEST(pictures, in_openexr_radiance_and_jpeg_are_read_and_others_are_not) {
    for (const char* name : {"a.exr", "a.jpg", "a.hdr"}) {
        const Folder folder;
        write_bytes(
            folder.path() / "a",
            written_by_openimageio(name, OIIO::ImageSpec(70, 50, 3, OIIO::TypeDesc::UINT8)));
        const Picture picture = read_picture(folder.path() / "a", room());
        EXPECT_EQ(picture.width, 70);
        EXPECT_EQ(picture.height, 50);
        EXPECT_EQ(picture.channels, 3);
        EXPECT_NEAR(picture.values[1000], 0.5, 0.01);
    }
    OIIO::ImageSpec tiled(70, 50, 4, OIIO::TypeDesc::HALF);
    tiled.tile_width = tiled.tile_height = 32;
    EXPECT_EQ(refusal_of(written_by_openimageio("a.exr", tiled)), "");
    for (const char* name : {"a.tif", "a.tga", "a.bmp", "a.gif"}) {
        const OIIO::ImageSpec spec(8, 8, 3, OIIO::TypeDesc::UINT8);
        EXPECT_NE(refusal_of(written_by_openimageio(name, spec)).find("neither a PNG nor a JPEG"),
                  std::string::npos)
            << name;
    }
}

TEST(pictures, in_radiance_are_refused_where_their_heads_are_wrong) {
    const FileBytes hdr =
        written_by_openimageio("a.hdr", OIIO::ImageSpec(70, 50, 3, OIIO::TypeDesc::FLOAT));
    ASSERT_EQ(refusal_of(hdr), "");
    const auto with = [&](const std::string& from, const std::string& to) {
        const std::string text(hdr.begin(), hdr.end());
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        const std::string changed = text.substr(0, at) + to + text.substr(at + from.size());
        return refusal_of({changed.begin(), changed.end()});
    };
    EXPECT_NE(with("-Y 50 +X 70", "+X 70 -Y 50").find("rows from the top"), std::string::npos);
    EXPECT_NE(with("-Y 50 +X 70", "-Y 2000000000 +X 70").find("pixels, more than"),
              std::string::npos);
    EXPECT_NE(with("_rgbe", "_xyze").find("XYZ"), std::string::npos);
    const FileBytes head(hdr.begin(), hdr.begin() + 20);
    EXPECT_NE(refusal_of(head).find("ends within the header"), std::string::npos);
    const FileBytes half(hdr.begin(), hdr.begin() + std::ssize(hdr) / 2);
    EXPECT_NE(refusal_of(half), "");
}

TEST(pictures, whose_heads_promise_too_much_are_refused_by_their_heads) {
    const FileBytes exr =
        written_by_openimageio("a.exr", OIIO::ImageSpec(70, 50, 3, OIIO::TypeDesc::HALF));
    FileBytes vast = exr;
    const std::string_view name = "dataWindow";
    const auto at = std::search(vast.begin(), vast.end(), name.begin(), name.end());
    ASSERT_NE(at, vast.end());
    const std::int32_t far = 2'000'000'000; // xMax, behind names, length, xMin and yMin
    std::memcpy(&*at + name.size() + 1 + 6 + 4 + 8, &far, sizeof far);
    EXPECT_NE(refusal_of(vast).find("2000000001x50 pixels"), std::string::npos) << refusal_of(vast);
    FileBytes deep = exr;
    deep[5] |= 0x08; // bit 11 of the version
    EXPECT_NE(refusal_of(deep).find("deep or of several parts"), std::string::npos);
    for (std::size_t size = 4; size < exr.size(); size += 7)
        EXPECT_NE(refusal_of({exr.begin(), exr.begin() + static_cast<std::ptrdiff_t>(size)}), "")
            << size;

    FileBytes jpeg =
        written_by_openimageio("a.jpg", OIIO::ImageSpec(70, 50, 3, OIIO::TypeDesc::UINT8));
    std::size_t frame = 0;
    while (jpeg[frame] != 0xff || jpeg[frame + 1] != 0xc0) ++frame;
    jpeg[frame + 5] = jpeg[frame + 7] = 0xff;
    EXPECT_NE(refusal_of(jpeg).find("pixels, more than"), std::string::npos) << refusal_of(jpeg);
    jpeg[frame + 1] = 0xc2; // progressive, of many scans
    for (int i = 0; i < 101; ++i) jpeg.insert(jpeg.end(), {0xff, 0xda});
    EXPECT_NE(refusal_of(jpeg).find("more than 100 scans"), std::string::npos) << refusal_of(jpeg);
}

} // namespace
} // namespace shadowproof::test
