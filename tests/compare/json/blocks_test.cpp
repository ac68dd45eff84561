#include "compare/json/blocks.h"

#include <gtest/gtest.h>

#include <random>

namespace shadowproof {
namespace {

std::vector<std::uint8_t> some_bytes(std::size_t size) {
    constexpr std::uint32_t seed = 20261121;
    std::mt19937 random(seed);
    std::vector<std::uint8_t> bytes(size);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() & 0x3U);
    return bytes;
}

TEST(Blocks, what_is_packed_is_unpacked_at_every_length) {
    for (std::size_t size = 0; size < 300; ++size) {
        const std::vector<std::uint8_t> bytes = some_bytes(size);
        EXPECT_EQ(unpacked(packed(std::as_bytes(std::span(bytes))), size), bytes) << size;
    }
}

TEST(Blocks, another_number_of_bytes_is_not_unpacked) {
    const std::vector<std::uint8_t> bytes = some_bytes(100);
    const std::string text = packed(std::as_bytes(std::span(bytes)));
    EXPECT_TRUE(unpacked(text, 100));
    EXPECT_FALSE(unpacked(text, 99));
    EXPECT_FALSE(unpacked(text, 101));
}

TEST(Blocks, no_single_changed_character_is_taken_for_the_same_bytes) {
    const std::vector<std::uint8_t> bytes = some_bytes(60);
    const std::string text = packed(std::as_bytes(std::span(bytes)));
    // The last character before the padding may hold bits that mean nothing.
    for (std::size_t i = 0; i + 4 < text.size(); ++i) {
        std::string damaged = text;
        damaged[i] = damaged[i] == 'A' ? 'B' : 'A';
        EXPECT_NE(unpacked(damaged, bytes.size()), bytes) << "character " << i;
    }
    EXPECT_FALSE(unpacked(text.substr(0, text.size() - 4), bytes.size()));
    EXPECT_FALSE(unpacked("@" + text.substr(1), bytes.size()));
}

TEST(Blocks, a_block_names_its_type_and_length_and_how_it_is_coded) {
    EXPECT_EQ(sequence_block(NumberList(std::vector<std::uint32_t>{1, 2, 3}), 3)
                  .rfind(R"({"type":"u32","length":3,"as":"sequence","columns":3,"sum":)", 0),
              0U);
    EXPECT_EQ(areas_block(NumberList(std::vector<std::int8_t>{}), 7)
                  .rfind(R"({"type":"i8","length":0,"as":"areas","width":7,"sum":)", 0),
              0U);
}

TEST(Blocks, no_byte_of_a_block_ends_its_string_or_its_line) {
    std::vector<std::uint32_t> values;
    std::mt19937 random(20261127);
    for (int i = 0; i < 20000; ++i) values.push_back(static_cast<std::uint32_t>(random()));
    const std::string text = sequence_block(NumberList(values));
    const std::size_t begin = text.find(R"("data":")") + 8;
    EXPECT_EQ(text.find_first_of("\r\n"), std::string::npos);
    std::size_t end = begin;
    while (text[end] != '"') end += text[end] == '\\' ? 2 : 1;
    EXPECT_EQ(text.substr(end), "\"}");
}

TEST(Blocks, a_memo_takes_no_block_for_another) {
    const NumberList values(std::vector<std::uint32_t>{1, 1, 2, 2, 1, 1, 2, 2, 3, 3, 3, 3});
    const NumberList bytes(std::vector<std::uint8_t>{1, 1, 2, 2, 1, 1, 2, 2, 3, 3, 3, 3});
    const NumberList guide(std::vector<std::uint32_t>{1, 1, 2, 2, 1, 1, 2, 2, 3, 3, 3, 4});
    const NumberList other(std::vector<std::uint32_t>{1, 2, 1, 2, 1, 2, 1, 2, 1, 2, 1, 2});
    const NumberList some(std::vector<std::uint8_t>{1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0});
    const NumberList rest(std::vector<std::uint8_t>{0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1});
    Memo memo;
    for (int round = 0; round < 2; ++round)
        for (Memo* const each : {static_cast<Memo*>(nullptr), &memo}) {
            const std::vector<std::string> blocks{
                areas_block(values, 4, {}, each),
                areas_block(values, 6, {}, each),
                areas_block(bytes, 4, {}, each),
                areas_block(values, 4, {"guide", &guide}, each),
                areas_block(values, 4, {"other", &guide}, each),
                areas_block(values, 4, {"other", &other}, each),
                differing_block(values, 4, some, {}, each),
                differing_block(values, 4, rest, {}, each),
                differing_block(values, 4, rest, {"guide", &other}, each),
                shades_block(bytes, 4, 1, {}, each),
                shades_block(bytes, 2, 1, {}, each)};
            for (std::size_t i = 0; i < blocks.size(); ++i)
                for (std::size_t k = 0; k < i; ++k) EXPECT_NE(blocks[i], blocks[k]) << i << k;
            EXPECT_EQ(blocks[3], areas_block(values, 4, {"guide", &guide}));
            EXPECT_EQ(blocks[7], differing_block(values, 4, rest));
        }
}

} // namespace
} // namespace shadowproof
