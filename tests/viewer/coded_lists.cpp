// Writes lists of diced numbers, each beside the block that it is coded as, as a list in JavaScript
// whose characters are bytes, for coded_test.mjs.
#include "compare/json/blocks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <random>

namespace shadowproof {
namespace {

using List = std::vector<std::uint32_t>;

struct Size {
    int width;
    int height;
    int lacking = 0; ///< pixels of the last row
    std::size_t pixels() const { return static_cast<std::size_t>(width * height - lacking); }
};

std::uint32_t diced(std::mt19937& random, std::uint32_t below) {
    return static_cast<std::uint32_t>(random()) % below;
}

/// Rectangles of a few values, and some pixels of any.
List areas(std::mt19937& random, const Size& size) {
    List values(size.pixels(), diced(random, 3));
    const std::uint32_t rectangles = diced(random, 6);
    for (std::uint32_t k = 0; k < rectangles; ++k) {
        const int left = static_cast<int>(diced(random, static_cast<std::uint32_t>(size.width)));
        const int top = static_cast<int>(diced(random, static_cast<std::uint32_t>(size.height)));
        const std::uint32_t value = diced(random, 5);
        for (int y = top; y < size.height; ++y)
            for (int x = left; x < size.width; ++x)
                if (const auto i = static_cast<std::size_t>(y * size.width + x); i < values.size())
                    values[i] = value;
    }
    const std::uint32_t scattered = diced(random, 2) == 0 ? 0 : diced(random, 20);
    for (std::uint32_t k = 0; k < scattered; ++k)
        values[diced(random, static_cast<std::uint32_t>(values.size()))] =
            static_cast<std::uint32_t>(random());
    return values;
}

/// The list with some values changed.
List nearly(std::mt19937& random, List values) {
    const std::uint32_t changes = diced(random, 3) * diced(random, 20);
    for (std::uint32_t k = 0; k < changes; ++k)
        values[diced(random, static_cast<std::uint32_t>(values.size()))] = diced(random, 5);
    return values;
}

void write(const std::string& block, const List& values, const List& guide, const List& mask) {
    std::cout << fmt::format("{{\"values\":[{}],\"guide\":[{}],\"mask\":[{}],\"block\":",
                             fmt::join(values, ","), fmt::join(guide, ","), fmt::join(mask, ","))
              << block << "},\n";
}

void write_areas(std::mt19937& random, const Size& size) {
    NumberList list;
    list.type = "u32";
    list.values = areas(random, size);
    NumberList guide{list};
    guide.values = nearly(random, list.values);
    write(areas_block(list, size.width), list.values, {}, {});
    write(areas_block(list, size.width, {"guide", &guide}), list.values, guide.values, {});
    NumberList mask{list};
    for (std::uint32_t& each : mask.values) each = diced(random, 2);
    NumberList masked{list};
    masked.values.clear();
    for (std::size_t i = 0; i < list.values.size(); ++i)
        if (mask.values[i] != 0) masked.values.push_back(list.values[i]);
    write(differing_block(masked, size.width, mask), masked.values, {}, mask.values);
    write(differing_block(masked, size.width, mask, {"guide", &guide}), masked.values, guide.values,
          mask.values);
}

void write_shades(std::mt19937& random, const Size& size, int channels) {
    NumberList list;
    list.type = "u8";
    for (std::size_t i = 0; i < static_cast<std::size_t>(channels) * size.pixels(); ++i)
        list.values.push_back((static_cast<std::uint32_t>(i) / 7 + diced(random, 3)) & 255U);
    NumberList guide{list};
    for (std::uint32_t& each : guide.values) each = (each + diced(random, 2)) & 255U;
    write(shades_block(list, size.width, channels), list.values, {}, {});
    write(shades_block(list, size.width, channels, {"guide", &guide}), list.values, guide.values,
          {});
}

/// Rows of numbers of which some give way, are left out, come in, or change places; now and then a
/// row is empty, or has a number twice.
void write_rows(std::mt19937& random, std::uint32_t rows, std::uint32_t most) {
    List row;
    List all;
    for (std::uint32_t k = 0; k < rows; ++k) {
        for (std::uint32_t changes = diced(random, 5); changes > 0; --changes) {
            const auto place = [&](std::size_t places) {
                return static_cast<std::ptrdiff_t>(
                    diced(random, static_cast<std::uint32_t>(places)));
            };
            const std::uint32_t number = 1 + diced(random, most);
            const std::uint32_t way = diced(random, 4);
            if (way == 0 || row.empty())
                row.insert(row.begin() + place(row.size() + 1), number);
            else if (way == 1)
                row.erase(row.begin() + place(row.size()));
            else if (way == 2)
                row[static_cast<std::size_t>(place(row.size()))] = number;
            else
                std::swap(row[static_cast<std::size_t>(place(row.size()))], row.back());
        }
        if (diced(random, 20) == 0) row.clear();
        all.insert(all.end(), row.begin(), row.end());
        all.push_back(0);
    }
    NumberList list;
    list.type = "u32";
    list.values = all;
    write(rows_block(list), all, {}, {});
}

void write_all() {
    std::mt19937 random(20261128);
    std::cout << "[\n";
    for (const int width : {1, 2, 15, 16, 17, 31, 32, 33, 100})
        for (const int height : {1, 2, 3, 20})
            for (int round = 0; round < 4; ++round) {
                const Size size{width, height};
                write_areas(random, size);
                const auto below = static_cast<std::uint32_t>(width);
                write_areas(random, {width, height, static_cast<int>(diced(random, below))});
                for (const int channels : {1, 3}) write_shades(random, size, channels);
                const List values = areas(random, size);
                write(sequence_block(NumberList(values), width), values, {}, {});
            }
    for (const std::uint32_t rows : {0U, 1U, 2U, 10U, 300U})
        for (const std::uint32_t most : {1U, 3U, 50U, 0xfffffffeU})
            for (int round = 0; round < 3; ++round) write_rows(random, rows, most);
    NumberList even;
    even.type = "u8";
    even.values = List(2000, 1);
    NumberList other{even};
    other.values = List(2000, 2);
    write(areas_block(even, 100), even.values, {}, {});
    write(areas_block(even, 100, {"guide", &other}), even.values, other.values, {});
    std::cout << "]\n";
}

} // namespace
} // namespace shadowproof

int main() {
    shadowproof::write_all();
    return std::cout.flush() ? 0 : 1;
}
