#include "compare/json/blocks.h"

#include "compare/json/coded_lists.h"
#include "scenes/cause.h"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <new>

namespace shadowproof {

namespace {

static_assert(std::endian::native == std::endian::little, "blocks are written as they lie");

/// It makes cause maps a third smaller than level 1 does.
constexpr int compression_level = 9;

struct FreeCompressor {
    void operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }
};
struct FreeDecompressor {
    void operator()(libdeflate_decompressor* d) const { libdeflate_free_decompressor(d); }
};

/// RFC 4648, section 4.
std::string to_base64(std::span<const std::uint8_t> bytes) {
    constexpr std::string_view alphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = std::min<std::size_t>(bytes.size() - i, 3);
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) bits = bits << 8U | (k < left ? bytes[i + k] : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= left ? alphabet[bits >> (18U - 6U * k) & 63U] : '=';
    }
    return text;
}

/// The six bits of a base64 character; nothing for any other character.
std::optional<std::uint32_t> sextet(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+') return 62;
    if (c == '/') return 63;
    return std::nullopt;
}

std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text) {
    if (text.size() % 4 != 0) return std::nullopt;
    std::size_t padding = 0;
    while (padding < 2 && padding < text.size() && text[text.size() - 1 - padding] == '=')
        ++padding;
    std::vector<std::uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text.substr(0, text.size() - padding)) {
        const std::optional<std::uint32_t> six = sextet(c);
        if (!six) return std::nullopt;
        bits = bits << 6U | *six;
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes.push_back(static_cast<std::uint8_t>(bits >> static_cast<unsigned>(count)));
    }
    return bytes;
}

/// Bytes as the characters of a string in a script that is read as x-user-defined
/// (encoding.spec.whatwg.org, section 14.5): every byte is one character.
std::string in_quotes(std::string_view bytes) {
    std::string text;
    text.reserve(bytes.size() + bytes.size() / 32 + 2);
    text += '"';
    for (const char c : bytes) {
        if (c == '"' || c == '\\' || c == '\n' || c == '\r') text += '\\';
        text += c == '\n' ? 'n' : c == '\r' ? 'r' : c;
    }
    return text + '"';
}

std::uint32_t sum_of(const std::vector<std::uint32_t>& values) {
    std::uint32_t sum = 2166136261U;
    for (const std::uint32_t value : values) sum = (sum ^ value) * 16777619U;
    return sum;
}

std::string words_of(int width, const Guide& guide) {
    return fmt::format(R"("width":{},)", width) +
           (guide.list == nullptr ? "" : fmt::format(R"("guide":"{}",)", guide.name));
}

/// What a list is coded by, too: none, one or two lists.
using Beside = std::array<Numbers, 2>;

/// `how`: further members, each with a comma behind it.
template <class Code>
std::string block(const NumberList& list, std::string_view as, const std::string& how,
                  const Beside& beside, Memo* memo, const Code& code) {
    const auto make = [&] {
        return fmt::format(R"({{"type":"{}","length":{},"as":"{}",{}"sum":{},"data":)", list.type,
                           list.values.size(), as, how, sum_of(list.values)) +
               in_quotes(code()) + "}";
    };
    return remembered(memo,
                      {bytes_for_memo(list.type), bytes_for_memo(as), bytes_for_memo(how),
                       bytes_for_memo(list.values), bytes_for_memo(beside[0]),
                       bytes_for_memo(beside[1])},
                      make);
}

Numbers values_of(const Guide& guide) {
    return guide.list != nullptr ? Numbers(guide.list->values) : Numbers();
}

} // namespace

std::string packed(std::span<const std::byte> bytes) {
    const std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor(
        libdeflate_alloc_compressor(compression_level));
    if (!compressor) throw std::bad_alloc();
    std::vector<std::uint8_t> stream(
        libdeflate_zlib_compress_bound(compressor.get(), bytes.size()));
    stream.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(),
                                           stream.data(), stream.size()));
    return to_base64(stream);
}

std::optional<std::vector<std::uint8_t>> unpacked(std::string_view text, std::size_t size) {
    const std::optional<std::vector<std::uint8_t>> stream = from_base64(text);
    if (!stream) return std::nullopt;
    const std::unique_ptr<libdeflate_decompressor, FreeDecompressor> decompressor(
        libdeflate_alloc_decompressor());
    if (!decompressor) throw std::bad_alloc();
    std::vector<std::uint8_t> bytes(size);
    // Without an output for the actual size, any size other than `size` is an error.
    const libdeflate_result result = libdeflate_zlib_decompress(
        decompressor.get(), stream->data(), stream->size(), bytes.data(), bytes.size(), nullptr);
    if (result != LIBDEFLATE_SUCCESS) return std::nullopt;
    return bytes;
}

NumberList differing_list(const Image<std::uint8_t>& cause) {
    return NumberList(converted<std::uint8_t>(cause, [](std::uint8_t each) {
                          return static_cast<std::uint8_t>(each == no_difference ? 0 : 1);
                      }).pixels);
}

std::string areas_block(const NumberList& list, int width, const Guide& guide, Memo* memo) {
    const Numbers beside = values_of(guide);
    return block(list, "areas", words_of(width, guide), {beside}, memo, [&] {
        return coded_areas(list.values, static_cast<std::uint32_t>(width), beside, {});
    });
}

std::string differing_block(const NumberList& list, int width, const NumberList& differing,
                            const Guide& guide, Memo* memo) {
    const Numbers mask = differing.values;
    const Numbers beside = values_of(guide);
    return block(
        list, "areas", words_of(width, guide) + R"("of":"differing",)", {mask, beside}, memo,
        [&] { return coded_areas(list.values, static_cast<std::uint32_t>(width), beside, mask); });
}

std::string shades_block(const NumberList& list, int width, int channels, const Guide& guide,
                         Memo* memo) {
    const Numbers beside = values_of(guide);
    const std::string how = fmt::format(R"("channels":{},)", channels) + words_of(width, guide);
    return block(list, "shades", how, {beside}, memo, [&] {
        return coded_shades(list.values, static_cast<std::uint32_t>(width),
                            static_cast<std::uint32_t>(channels), beside);
    });
}

std::string sequence_block(const NumberList& list, int columns) {
    return block(list, "sequence", fmt::format(R"("columns":{},)", columns), {}, nullptr,
                 [&] { return coded_sequence(list.values, static_cast<std::uint32_t>(columns)); });
}

std::string rows_block(const NumberList& list) {
    return block(list, "rows", "", {}, nullptr, [&] { return coded_rows(list.values); });
}

} // namespace shadowproof
