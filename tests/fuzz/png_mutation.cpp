#include "tests/fuzz/png_mutation.h"

#include <libdeflate.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <string_view>

namespace shadowproof::fuzz {

namespace {

constexpr std::array<std::uint8_t, 8> signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::size_t most_pixel_bytes = 1U << 18U;

std::uint32_t big_endian(const std::uint8_t* bytes) {
    return std::uint32_t{bytes[0]} << 24U | std::uint32_t{bytes[1]} << 16U |
           std::uint32_t{bytes[2]} << 8U | bytes[3];
}

void put_big_endian(FileBytes& bytes, std::uint32_t word) {
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes.push_back(static_cast<std::uint8_t>(word >> shift));
}

bool is(const PngChunk& chunk, const char* type) {
    return std::memcmp(chunk.type.data(), type, 4) == 0;
}

std::optional<FileBytes> inflated(const FileBytes& packed) {
    const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>
        inflater(libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
    FileBytes bytes(most_pixel_bytes);
    std::size_t size = 0;
    if (libdeflate_zlib_decompress(inflater.get(), packed.data(), packed.size(), bytes.data(),
                                   bytes.size(), &size) != LIBDEFLATE_SUCCESS)
        return std::nullopt;
    bytes.resize(size);
    return bytes;
}

FileBytes deflated(const FileBytes& bytes) {
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> deflater(
        libdeflate_alloc_compressor(1), &libdeflate_free_compressor);
    FileBytes packed(libdeflate_zlib_compress_bound(deflater.get(), bytes.size()));
    packed.resize(libdeflate_zlib_compress(deflater.get(), bytes.data(), bytes.size(),
                                           packed.data(), packed.size()));
    return packed;
}

void change_bytes(FileBytes& bytes, Dice& dice) {
    if (bytes.empty() || dice.one_in(8)) {
        bytes.insert(bytes.end(), 1 + dice.below(4), static_cast<std::uint8_t>(dice.bits()));
        return;
    }
    if (dice.one_in(8)) return bytes.resize(dice.below(bytes.size()));
    for (std::size_t n = 1 + dice.below(3); n > 0; --n)
        dice.one_of(bytes) = static_cast<std::uint8_t>(dice.one_in(3) ? 255 : dice.bits());
}

/// Width, height, bits, colour type, interlacing: a field that fits, mostly.
void change_header(FileBytes& header, Dice& dice) {
    if (header.size() != 13) return change_bytes(header, dice);
    static constexpr std::array<std::uint8_t, 6> depths{1, 2, 4, 8, 16, 0};
    static constexpr std::array<std::uint8_t, 6> types{0, 2, 3, 4, 6, 1};
    switch (dice.below(5)) {
    case 0:
        header[8] = dice.one_of(depths);
        return;
    case 1:
        header[9] = dice.one_of(types);
        return;
    case 2:
        header[12] = static_cast<std::uint8_t>(dice.below(3));
        return;
    case 3:
        header[dice.one_in(2) ? 3 : 7] = static_cast<std::uint8_t>(dice.below(20));
        return;
    default:
        header[dice.below(8)] = static_cast<std::uint8_t>(dice.bits());
    }
}

/// All pixel chunks become one.
void change_pixels(std::vector<PngChunk>& chunks, Dice& dice) {
    FileBytes packed;
    PngChunk* first = nullptr;
    for (PngChunk& chunk : chunks)
        if (is(chunk, "IDAT")) {
            if (first == nullptr) first = &chunk;
            packed.insert(packed.end(), chunk.content.begin(), chunk.content.end());
        }
    if (first == nullptr) return;
    auto pixels = inflated(packed);
    if (!pixels) return;
    change_bytes(*pixels, dice);
    first->content = deflated(*pixels);
    const PngChunk kept = *first;
    std::erase_if(chunks, [](const PngChunk& chunk) { return is(chunk, "IDAT"); });
    chunks.insert(chunks.empty() ? chunks.end() : chunks.end() - 1, kept);
}

} // namespace

std::optional<std::vector<PngChunk>> read_png(std::span<const std::uint8_t> bytes) {
    if (bytes.size() < signature.size() ||
        !std::equal(signature.begin(), signature.end(), bytes.begin()))
        return std::nullopt;
    std::vector<PngChunk> chunks;
    for (std::size_t at = signature.size(); bytes.size() - at >= 12;) {
        const std::size_t length = big_endian(bytes.data() + at);
        if (length > bytes.size() - at - 12) break;
        PngChunk& chunk = chunks.emplace_back();
        std::copy_n(bytes.data() + at + 4, 4, chunk.type.begin());
        chunk.content.assign(bytes.data() + at + 8, bytes.data() + at + 8 + length);
        at += 12 + length;
    }
    return chunks;
}

FileBytes written(const std::vector<PngChunk>& chunks) {
    FileBytes bytes(signature.begin(), signature.end());
    for (const PngChunk& chunk : chunks) {
        put_big_endian(bytes, static_cast<std::uint32_t>(chunk.content.size()));
        const std::size_t checked = bytes.size();
        bytes.insert(bytes.end(), chunk.type.begin(), chunk.type.end());
        bytes.insert(bytes.end(), chunk.content.begin(), chunk.content.end());
        put_big_endian(bytes, libdeflate_crc32(0, bytes.data() + checked, bytes.size() - checked));
    }
    return bytes;
}

void mutate_png(std::vector<PngChunk>& chunks, Dice& dice) {
    static constexpr std::array<std::string_view, 16> types{
        "IHDR", "IDAT", "IEND", "PLTE", "tRNS", "gAMA", "cHRM", "sRGB",
        "iCCP", "tEXt", "zTXt", "iTXt", "pHYs", "sBIT", "bKGD", "eXIf"};
    if (chunks.empty()) return;
    switch (dice.below(8)) {
    case 0:
        return change_header(chunks.front().content, dice);
    case 1: {
        PngChunk added;
        std::memcpy(added.type.data(), dice.one_of(types).data(), 4);
        added.content.assign(dice.below(800), static_cast<std::uint8_t>(dice.bits()));
        chunks.insert(chunks.begin() + static_cast<std::ptrdiff_t>(dice.below(chunks.size() + 1)),
                      std::move(added));
        return;
    }
    case 2:
        return std::swap(dice.one_of(chunks), dice.one_of(chunks));
    case 3:
        chunks.erase(chunks.begin() + static_cast<std::ptrdiff_t>(dice.below(chunks.size())));
        return;
    case 4:
        std::memcpy(dice.one_of(chunks).type.data(), dice.one_of(types).data(), 4);
        return;
    case 5:
    case 6:
        return change_pixels(chunks, dice);
    default:
        return change_bytes(dice.one_of(chunks).content, dice);
    }
}

} // namespace shadowproof::fuzz
