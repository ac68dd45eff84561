// Pictures and lists of numbers as text that JSON and JavaScript hold: base64 of a zlib stream.
#pragma once

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

/// "u8", "i32", "f32": a number's type as the viewer names it.
template <class T>
constexpr std::string_view type_name() {
    if constexpr (std::is_same_v<T, std::uint8_t>) return "u8";
    if constexpr (std::is_same_v<T, std::int8_t>) return "i8";
    if constexpr (std::is_same_v<T, std::uint32_t>) return "u32";
    if constexpr (std::is_same_v<T, std::int32_t>) return "i32";
    if constexpr (std::is_same_v<T, float>) return "f32";
    return {};
}

/// A block of the report's data files: {"type":"u32","length":7,"data":"..."}; little endian.
std::string block(std::string_view type, std::size_t length, std::span<const std::byte> bytes);

template <class T>
std::string block(const std::vector<T>& values) {
    static_assert(!type_name<T>().empty());
    return block(type_name<T>(), values.size(), std::as_bytes(std::span(values)));
}

} // namespace shadowproof
