// Pictures and lists of numbers as text: packed in JSON, and as blocks of the report's data files,
// which are scripts whose characters are bytes.
#pragma once

#include "compare/json/memo.h"
#include "scenes/image.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace shadowproof {

/// Base64 (RFC 4648) of a zlib stream (RFC 1950). The same bytes give the same text.
std::string packed(std::span<const std::byte> bytes);

/// The inverse of packed(). None if the text is damaged or does not hold `size` bytes.
std::optional<std::vector<std::uint8_t>> unpacked(std::string_view text, std::size_t size);

/// A list of numbers of one type, each as 32 bits: those of a float, and of a negative number its
/// two's complement.
struct NumberList {
    std::string_view type; ///< "u8", "i8", "u32", "i32", "f32": as the viewer names it
    std::vector<std::uint32_t> values;

    NumberList() = default;
    template <class T>
    explicit NumberList(std::span<const T> list) : type(type_name<T>()) {
        static_assert(!type_name<T>().empty());
        values.reserve(list.size());
        for (const T value : list)
            if constexpr (std::is_same_v<T, float>)
                values.push_back(std::bit_cast<std::uint32_t>(value));
            else
                values.push_back(static_cast<std::uint32_t>(value));
    }
    template <class T>
    explicit NumberList(const std::vector<T>& list) : NumberList(std::span<const T>(list)) {}

private:
    template <class T>
    static constexpr std::string_view type_name() {
        if constexpr (std::is_same_v<T, std::uint8_t> || std::is_enum_v<T>) return "u8";
        if constexpr (std::is_same_v<T, std::int8_t>) return "i8";
        if constexpr (std::is_same_v<T, std::uint32_t>) return "u32";
        if constexpr (std::is_same_v<T, std::int32_t>) return "i32";
        if constexpr (std::is_same_v<T, float>) return "f32";
        return {};
    }
};

/// 1 for each pixel that differs, else 0, by its cause.
NumberList differing_list(const Image<std::uint8_t>& cause);

/// A list that another one is guessed from: a block of the same file, or of the scene's.
struct Guide {
    std::string_view name; ///< none: empty
    const NumberList* list = nullptr;
};

/// Blocks of the report's data files, one for each way in which compare/json/coded_lists.h codes a
/// list: {"type":"u32","length":7,"as":"areas","sum":1234567,"data":"..."}. "sum" is the FNV-1a
/// hash (Fowler, Noll, Vo) of the list's numbers, 32 bits at a time, by which damage is found. With
/// a memo what was coded before is not coded again.
std::string areas_block(const NumberList& list, int width, const Guide& guide = {},
                        Memo* memo = nullptr);
/// Of the pixels that differ; `differing` has a number for each pixel, not 0 where it does. The
/// guide has one for each pixel, too.
std::string differing_block(const NumberList& list, int width, const NumberList& differing,
                            const Guide& guide = {}, Memo* memo = nullptr);
/// `channels` bytes for each pixel.
std::string shades_block(const NumberList& list, int width, int channels, const Guide& guide = {},
                         Memo* memo = nullptr);
std::string sequence_block(const NumberList& list, int columns = 1);
std::string rows_block(const NumberList& list);

} // namespace shadowproof
