#include "scenes/error.h"
#include "scenes/load/picture/pcx.h"
#include "tests/scenes/small_pcx.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace shadowproof::test {
namespace {

const MemoryAccount plenty({std::uint64_t{1} << 32U, "the test"});

Picture decoded(const FileBytes& bytes, std::uint64_t most_pixels = 1U << 20U) {
    return decode_pcx(bytes, "skin.pcx", {.memory = plenty, .most_pixels = most_pixels});
}

std::string refusal_of(const FileBytes& bytes, std::uint64_t most_pixels = 1U << 20U) {
    try {
        decoded(bytes, most_pixels);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(pcx, has_the_palettes_colours_of_its_pixels) {
    for (const glm::ivec2 size : {glm::ivec2(16, 16), glm::ivec2(7, 5), glm::ivec2(300, 2)}) {
        const Picture picture = decoded(small_pcx(size.x, size.y));
        ASSERT_EQ(glm::ivec2(picture.width, picture.height), size);
        ASSERT_EQ(picture.channels, 3);
        EXPECT_EQ(picture.bits, 8);
        std::size_t at = 0;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                for (const std::uint8_t channel : palette_color((16 * y + x) % 256))
                    ASSERT_EQ(picture.values[at++], static_cast<float>(channel / 255.0))
                        << x << ", " << y;
    }
}

/// Three planes a row, of channel values 1, 2, 3 and so on.
FileBytes rgb_pcx(int width, int height) {
    FileBytes bytes = small_pcx(width, height);
    bytes.resize(128);
    bytes[65] = 3;
    for (int i = 0; i < 3 * width * height; ++i) bytes.push_back(static_cast<std::uint8_t>(i + 1));
    return bytes;
}

TEST(pcx, of_three_planes_has_their_colours) {
    const Picture picture = decoded(rgb_pcx(16, 2));
    ASSERT_EQ(picture.values.size(), 96U);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 16; ++x)
            for (int k = 0; k < 3; ++k)
                EXPECT_EQ(picture.values[static_cast<std::size_t>(3 * (16 * y + x) + k)],
                          static_cast<float>((16 * (3 * y + k) + x + 1) / 255.0));
}

TEST(pcx, is_refused_before_it_is_decoded_where_it_does_not_fit) {
    const FileBytes bytes = small_pcx(16, 16);
    constexpr std::uint64_t padded = 16 + 128;
    const std::uint64_t needed =
        256 * 3 * sizeof(float) + 4 * padded * padded + 3 * 256 + bytes.size();
    const MemoryAccount enough({program_bytes + needed, "the test"});
    EXPECT_NO_THROW(decode_pcx(bytes, "a", {.memory = enough, .most_pixels = 256}));
    const MemoryAccount less({program_bytes + needed - 1, "the test"});
    EXPECT_THROW(decode_pcx(bytes, "a", {.memory = less, .most_pixels = 256}), Error);
}

TEST(pcx, that_is_damaged_or_too_large_is_refused_by_name) {
    const FileBytes whole = small_pcx(16, 16);
    FileBytes bytes(whole.begin(), whole.begin() + 200);
    EXPECT_NE(refusal_of(bytes).find("skin.pcx: is damaged"), std::string::npos)
        << refusal_of(bytes);
    // Rows that are missing before the palette, or at the end of one without a palette.
    bytes = whole;
    bytes.erase(bytes.begin() + 128, bytes.begin() + 160);
    EXPECT_NE(refusal_of(bytes).find("ends within its rows"), std::string::npos)
        << refusal_of(bytes);
    bytes = rgb_pcx(16, 2);
    EXPECT_EQ(refusal_of(bytes), "");
    bytes.pop_back();
    EXPECT_NE(refusal_of(bytes).find("ends within its rows"), std::string::npos)
        << refusal_of(bytes);
    EXPECT_NE(refusal_of({1, 2, 3}).find("is no PCX picture"), std::string::npos);
    EXPECT_NE(refusal_of(whole, 255).find("skin.pcx"), std::string::npos);
    bytes = whole;
    bytes[8] = 0;
    bytes[4] = 1; // from column 1 to column 0
    EXPECT_NE(refusal_of(bytes).find("0x16"), std::string::npos) << refusal_of(bytes);
    bytes = whole;
    bytes[3] = 3;
    EXPECT_NE(refusal_of(bytes), "");
}

TEST(pcx, that_is_mutated_decodes_or_is_refused) {
    constexpr unsigned seed = 19971209;
    std::mt19937 random(seed);
    const FileBytes whole = small_pcx(16, 16);
    int kept = 0;
    constexpr int mutations = 2000;
    for (int i = 0; i < mutations; ++i) {
        FileBytes bytes = whole;
        for (int n = 0; n < 3; ++n)
            bytes[random() % (n == 0 ? 128 : bytes.size())] = static_cast<std::uint8_t>(random());
        if (i % 4 == 0) bytes.resize(1 + random() % bytes.size());
        try {
            const Picture picture = decoded(bytes);
            ++kept;
            ASSERT_EQ(picture.values.size(), static_cast<std::size_t>(3) *
                                                 static_cast<std::size_t>(picture.width) *
                                                 static_cast<std::size_t>(picture.height));
        } catch (const Error&) { // as it should be
        }
    }
    EXPECT_GT(kept, 0);
    EXPECT_LT(kept, mutations);
}

} // namespace
} // namespace shadowproof::test
