#include "tests/scenes/small_pcx.h"

namespace shadowproof::test {

std::array<std::uint8_t, 3> palette_color(int i) {
    return {static_cast<std::uint8_t>(3 * i), static_cast<std::uint8_t>(255 - i),
            static_cast<std::uint8_t>(7 * i + 1)};
}

FileBytes small_pcx(int width, int height) {
    FileBytes bytes(128);
    const auto set_word = [&](std::size_t at, int value) {
        bytes[at] = static_cast<std::uint8_t>(value);
        bytes[at + 1] = static_cast<std::uint8_t>(value >> 8);
    };
    bytes[0] = 10; // ZSoft
    bytes[1] = 5;  // with a palette
    bytes[2] = 1;  // run lengths
    bytes[3] = 8;  // bits
    set_word(8, width - 1);
    set_word(10, height - 1);
    bytes[65] = 1; // planes
    set_word(66, width + width % 2);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width + width % 2; ++x) {
            const int index = (16 * y + x) % 256;
            if (index >= 0xC0) bytes.push_back(0xC1); // a run of one
            bytes.push_back(static_cast<std::uint8_t>(index));
        }
    bytes.push_back(12); // the palette
    for (int i = 0; i < 256; ++i)
        for (const std::uint8_t channel : palette_color(i)) bytes.push_back(channel);
    return bytes;
}

} // namespace shadowproof::test
