// The bytes of a compressed stream, one after the other. A stream that ends too early is refused.
#pragma once

#include "scenes/load/common/place.h"

#include <cstdint>
#include <span>

namespace shadowproof {

using Bytes = std::span<const unsigned char>;

class ByteReader {
public:
    /// `place` names the stream in messages.
    ByteReader(Bytes bytes, const Place& place) : bytes_(bytes), place_(place) {}

    std::uint8_t byte() { return take(1)[0]; }
    Bytes take(std::size_t count) {
        if (count > left()) refuse("ends too early");
        const Bytes taken = bytes_.subspan(at_, count);
        at_ += count;
        return taken;
    }
    /// LEB128: seven bits in each byte, lowest first. What exceeds 32 bits is refused.
    std::uint32_t number() {
        std::uint64_t value = 0;
        for (unsigned shift = 0; shift < 35; shift += 7) {
            const std::uint64_t next = byte();
            value |= (next & 0x7fU) << shift;
            if (next < 0x80U) return static_cast<std::uint32_t>(value);
        }
        refuse("holds a number of more than 32 bits");
    }
    std::size_t left() const { return bytes_.size() - at_; }
    [[noreturn]] void refuse(const std::string& what) const {
        place_.refuse("holds a compressed stream that " + what, "compress the asset again");
    }

private:
    Bytes bytes_;
    const Place& place_;
    std::size_t at_ = 0;
};

/// Zigzag coding: 0, 1, 2, 3 stand for 0, -1, 1, -2; modulo the width of the type.
template <class T>
constexpr T unzigzagged(T value) {
    return static_cast<T>((value >> 1U) ^ static_cast<T>(-static_cast<T>(value & 1U)));
}

} // namespace shadowproof
