#include "scenes/load/picture/picture_head.h"

#include "scenes/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <optional>
#include <string_view>

namespace shadowproof {

namespace {

using Bytes = std::span<const unsigned char>;

template <std::size_t n>
bool begins_with(Bytes bytes, const std::array<unsigned char, n>& magic) {
    return bytes.size() > n && std::equal(magic.begin(), magic.end(), bytes.begin());
}

} // namespace

std::optional<PictureFormat> format_of(Bytes bytes) {
    constexpr std::array<unsigned char, 8> png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    constexpr std::array<unsigned char, 3> jpeg{0xff, 0xd8, 0xff};
    constexpr std::array<unsigned char, 4> openexr{0x76, 0x2f, 0x31, 0x01};
    if (begins_with(bytes, png)) return PictureFormat::png;
    if (begins_with(bytes, jpeg)) return PictureFormat::jpeg;
    if (begins_with(bytes, openexr)) return PictureFormat::openexr;
    constexpr std::array<unsigned char, 10> radiance{'#', '?', 'R', 'A', 'D',
                                                     'I', 'A', 'N', 'C', 'E'};
    constexpr std::array<unsigned char, 6> rgbe{'#', '?', 'R', 'G', 'B', 'E'};
    if (begins_with(bytes, radiance) || begins_with(bytes, rgbe)) return PictureFormat::radiance;
    return std::nullopt;
}

namespace {

constexpr unsigned char start_of_scan = 0xDA;
constexpr unsigned char first_frame = 0xC0; // SOF0
constexpr unsigned char last_frame = 0xCF;  // SOF15

/// SOF0 to SOF15, except DHT, JPG and DAC, which lie among them.
bool is_frame(unsigned char marker) {
    return marker >= first_frame && marker <= last_frame && marker != 0xC4 && marker != 0xC8 &&
           marker != 0xCC;
}

/// SOF2 and the other frames whose scans each hold a part of every coefficient.
bool is_progressive(unsigned char marker) {
    return marker == 0xC2 || marker == 0xC6 || marker == 0xCA || marker == 0xCE;
}

/// Scans, including what only looks like the head of one, in a thumbnail or a comment.
std::size_t scans_in(Bytes bytes) {
    std::size_t scans = 0;
    for (std::size_t i = 0; i + 1 < bytes.size(); ++i)
        if (bytes[i] == 0xff && bytes[i + 1] == start_of_scan) ++scans;
    return scans;
}

/// The frame's header, after its marker: length 2, precision 1, height 2, width 2, components.
PictureHead frame_head(Bytes bytes, std::size_t at, bool progressive) {
    const auto word = [&](std::size_t offset) {
        return static_cast<std::uint64_t>(bytes[at + offset]) << 8U | bytes[at + offset + 1];
    };
    PictureHead head{.width = word(5), .height = word(3), .channels = bytes[at + 7]};
    // Rows of blocks for a window of 16 lines and colours converted; of a progressive one, all
    // coefficients, two bytes each, in blocks of up to 32 per side where components are subsampled.
    constexpr std::uint64_t block = 32;
    const std::uint64_t row = (head.width + block) * head.channels;
    head.decoder_bytes = row * (progressive ? 2 * (head.height + block) : 0) + row * 16 * 8;
    return head;
}

} // namespace

PictureHead jpeg_head(Bytes bytes, const std::string& where) {
    constexpr std::size_t most_scans = 100;
    constexpr std::size_t frame_bytes = 8;
    for (std::size_t at = 2; at + 4 + frame_bytes <= bytes.size();) {
        if (bytes[at] != 0xff) break;
        const unsigned char marker = bytes[at + 1];
        if (marker == 0xff) { // padding
            ++at;
            continue;
        }
        if (is_frame(marker)) {
            if (is_progressive(marker) && scans_in(bytes) > most_scans)
                throw Error(where, fmt::format("has more than {} scans", most_scans),
                            picture_remedy);
            return frame_head(bytes, at + 2, is_progressive(marker));
        }
        if (marker == start_of_scan) break;
        at += 2 + (static_cast<std::size_t>(bytes[at + 2]) << 8U | bytes[at + 3]);
    }
    throw Error(where, "is a damaged JPEG: it has no frame", picture_remedy);
}

namespace {

/// The attributes of an OpenEXR header, one after the other.
class Attributes {
public:
    Attributes(Bytes bytes, const std::string& where) : rest_(bytes), where_(where) {}

    /// False at the end of the header.
    bool next() {
        name_ = text();
        if (name_.empty()) return false;
        text(); // its type
        const std::uint32_t size = number<std::uint32_t>(take(4));
        value_ = take(size);
        return true;
    }
    std::string_view name() const { return name_; }
    Bytes value() const { return value_; }

    template <class T>
    T number(Bytes bytes, std::size_t offset = 0) const {
        T result{};
        if (bytes.size() < offset + sizeof result) refuse();
        std::memcpy(&result, bytes.data() + offset, sizeof result);
        return result;
    }
    [[noreturn]] void refuse() const {
        throw Error(where_, "is a damaged OpenEXR file: its header is cut", picture_remedy);
    }

private:
    Bytes rest_;
    const std::string& where_;
    std::string_view name_;
    Bytes value_;

    Bytes take(std::size_t size) {
        if (size > rest_.size()) refuse();
        const Bytes taken = rest_.first(size);
        rest_ = rest_.subspan(size);
        return taken;
    }
    std::string_view text() {
        const auto end = std::find(rest_.begin(), rest_.end(), 0);
        if (end == rest_.end()) refuse();
        const auto length = static_cast<std::size_t>(end - rest_.begin());
        const Bytes taken = take(length + 1);
        return {reinterpret_cast<const char*>(taken.data()), length};
    }
};

/// Names ended by NUL, 16 bytes behind each, and an empty name at the end.
std::uint64_t channels_in(Bytes list) {
    std::uint64_t channels = 0;
    for (std::size_t at = 0; at < list.size() && list[at] != 0; ++channels) {
        while (at < list.size() && list[at] != 0) ++at;
        at += 1 + 16;
    }
    return channels;
}

} // namespace

PictureHead openexr_head(Bytes bytes, const std::string& where) {
    constexpr std::uint32_t other_kinds = 0x800 | 0x1000; // deep, of several parts
    constexpr std::uint64_t largest_tile = 4096;
    Attributes attributes(bytes.subspan(std::min<std::size_t>(bytes.size(), 8)), where);
    if ((attributes.number<std::uint32_t>(bytes, 4) & other_kinds) != 0)
        throw Error(where, "is an OpenEXR file that is deep or of several parts",
                    "write a flat one, of one part");
    PictureHead head;
    std::uint64_t rows_at_once = 256; // of the most that any compression takes
    while (attributes.next()) {
        const Bytes value = attributes.value();
        if (attributes.name() == "dataWindow") {
            const auto side = [&](std::size_t low, std::size_t high) {
                const std::int64_t length =
                    std::int64_t{attributes.number<std::int32_t>(value, high)} -
                    attributes.number<std::int32_t>(value, low) + 1;
                return static_cast<std::uint64_t>(std::max<std::int64_t>(length, 0));
            };
            head.width = side(0, 8);
            head.height = side(4, 12);
        } else if (attributes.name() == "channels") {
            head.channels = channels_in(value);
        } else if (attributes.name() == "tiles") {
            const auto across = attributes.number<std::uint32_t>(value, 0);
            const auto down = attributes.number<std::uint32_t>(value, 4);
            if (across < 1 || across > largest_tile || down < 1 || down > largest_tile)
                throw Error(where,
                            fmt::format("has tiles of {}x{}, more than {} a side", across, down,
                                        largest_tile),
                            "write smaller tiles, or scanlines");
            rows_at_once = std::max<std::uint64_t>(rows_at_once, down);
            head.decoder_bytes += 4 * std::uint64_t{across} * down; // by channels below
        }
    }
    // Below 2^33 each, and sizes are held against a limit before they are multiplied further.
    if (head.width > 1U << 20U || head.height > 1U << 20U || head.channels > 64)
        throw Error(where,
                    fmt::format("is a picture of {}x{} pixels and {} channels", head.width,
                                head.height, head.channels),
                    "scale it down");
    // Rows as compressed, as stored and as converted, 4 bytes per value each; the offset of each
    // row, 8 bytes.
    head.decoder_bytes = 4 * head.decoder_bytes * head.channels +
                         3 * 4 * rows_at_once * head.width * head.channels +
                         16 * head.width * head.height;
    return head;
}

namespace {

/// The next line of a header, without its end; nothing where none ends within `most` bytes, more
/// than any header has.
std::optional<std::string_view> next_line(Bytes bytes, std::size_t& at) {
    constexpr std::size_t most = 65536;
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                                std::min(bytes.size(), most));
    const std::size_t end = text.find('\n', at);
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view line = text.substr(at, end - at);
    at = end + 1;
    return line;
}

/// The number that `text` begins with, which is then left out; nothing where there is none.
std::optional<std::uint64_t> taken_number(std::string_view& text) {
    std::uint64_t number = 0;
    const char* const end = text.data() + text.size();
    const auto [parsed, failure] = std::from_chars(text.data(), end, number);
    if (failure != std::errc()) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(parsed - text.data()));
    return number;
}

bool taken(std::string_view& text, std::string_view word) {
    if (!text.starts_with(word)) return false;
    text.remove_prefix(word.size());
    return true;
}

} // namespace

PictureHead radiance_head(Bytes bytes, const std::string& where) {
    std::size_t at = 0;
    std::optional<std::string_view> line = next_line(bytes, at);
    bool is_rgb = true;
    while (line && !line->empty()) { // variables, and an empty line behind them
        if (line->starts_with("FORMAT=")) is_rgb = line->starts_with("FORMAT=32-bit_rle_rgbe");
        line = next_line(bytes, at);
    }
    line = line ? next_line(bytes, at) : line;
    if (!line) throw Error(where, "ends within the header of a Radiance picture", picture_remedy);
    if (!is_rgb)
        throw Error(where, "is a Radiance picture of XYZ, which is not decoded",
                    "export it as RGB (32-bit_rle_rgbe)");
    std::string_view size = *line;
    std::optional<std::uint64_t> height;
    std::optional<std::uint64_t> width;
    if (taken(size, "-Y ")) height = taken_number(size);
    if (height && taken(size, " +X ")) width = taken_number(size);
    if (!width || !size.empty() || *width == 0 || *height == 0)
        throw Error(
            where,
            fmt::format("has a Radiance picture of rows \"{}\", which is not decoded", *line),
            "export it with rows from the top (-Y height +X width)");
    // The decoder holds a row of 4 bytes a pixel, twice at most, and a row of floats.
    return {.width = *width, .height = *height, .channels = 3, .decoder_bytes = 20 * *width};
}

} // namespace shadowproof
