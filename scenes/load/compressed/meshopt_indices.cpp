#include "scenes/load/compressed/meshopt_parts.h"

#include <array>
#include <cstring>

namespace shadowproof::meshopt {

namespace {

constexpr std::uint8_t triangles_header = 0xe1;
constexpr std::uint8_t indices_header = 0xd1;
constexpr std::size_t table_bytes = 16;  ///< at the end of triangles: pairs of codes
constexpr std::size_t padding_bytes = 4; ///< at the end of indices

/// Writes indices of 2 or 4 bytes one after the other.
class IndexWriter {
public:
    IndexWriter(std::size_t stride, std::span<unsigned char> target)
        : stride_(stride), at_(target.data()) {}

    void put(std::uint32_t index) { // little-endian, as glTF's buffers are
        std::memcpy(at_, &index, stride_);
        at_ += stride_;
    }

private:
    std::size_t stride_;
    unsigned char* at_;
};

/// The last 16 that were pushed.
template <class T>
class Recent {
public:
    void push(const T& value) { values_.at(next_++ % values_.size()) = value; }
    /// 0: the last one.
    const T& operator[](std::size_t age) const {
        return values_.at((next_ - 1 - age) % values_.size());
    }

private:
    std::array<T, 16> values_{};
    std::size_t next_ = 16; ///< never below: ages are at most 15
};

struct Edge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
};

/// Decodes triangles one by one. Indices may come out as anything; their readers check them.
class TriangleDecoder {
public:
    TriangleDecoder(ByteReader codes, ByteReader numbers, Bytes table)
        : codes_(codes), numbers_(numbers), table_(table) {}

    void triangle(IndexWriter& target) {
        const unsigned code = codes_.byte();
        const unsigned high = code >> 4U;
        const unsigned low = code & 15U;
        std::array<std::uint32_t, 3> corners{};
        if (high < 15) {
            const Edge edge = edges_[high];
            corners = {edge.from, edge.to, third(low)};
        } else {
            corners = low < 14 ? by_table(table_[low]) : by_code(low);
            edges_.push({corners[1], corners[0]});
        }
        // A neighbour runs along a shared edge in the other direction.
        edges_.push({corners[2], corners[1]});
        edges_.push({corners[0], corners[2]});
        for (const std::uint32_t corner : corners) target.put(corner);
    }

    std::size_t left() const { return numbers_.left(); }

private:
    ByteReader codes_;
    ByteReader numbers_;
    Bytes table_;
    Recent<Edge> edges_;
    Recent<std::uint32_t> vertices_;
    std::uint32_t next_ = 0; ///< the lowest index that is not used yet
    std::uint32_t last_ = 0; ///< what differences are to

    std::uint32_t pushed(std::uint32_t vertex) {
        vertices_.push(vertex);
        return vertex;
    }
    std::uint32_t by_difference() { return last_ += unzigzagged(numbers_.number()); }

    /// The corner opposite to an edge that was seen before.
    std::uint32_t third(unsigned code) {
        if (code == 0) return pushed(next_++);
        if (code < 13) return vertices_[code];
        if (code == 13) return pushed(--last_);
        if (code == 14) return pushed(++last_);
        return pushed(by_difference());
    }

    /// Three corners of which the first is new, and the others new or seen before.
    std::array<std::uint32_t, 3> by_table(unsigned pair) {
        const unsigned second = pair >> 4U;
        const unsigned third = pair & 15U;
        const std::uint32_t a = next_++;
        const std::uint32_t b = second == 0 ? next_++ : vertices_[second - 1];
        const std::uint32_t c = third == 0 ? next_++ : vertices_[third - 1];
        vertices_.push(a);
        if (second == 0) vertices_.push(b);
        if (third == 0) vertices_.push(c);
        return {a, b, c};
    }

    std::uint32_t free_corner(unsigned code) {
        if (code == 0) return next_++;
        return code == 15 ? by_difference() : vertices_[code - 1];
    }

    /// Three corners of any kind; a pair of codes of 0 begins to count anew.
    std::array<std::uint32_t, 3> by_code(unsigned low) {
        const unsigned pair = numbers_.byte();
        if (pair == 0) next_ = 0;
        const unsigned second = pair >> 4U;
        const unsigned third = pair & 15U;
        const std::uint32_t a = low == 14 ? next_++ : by_difference();
        const std::uint32_t b = free_corner(second);
        const std::uint32_t c = free_corner(third);
        vertices_.push(a);
        if (second == 0 || second == 15) vertices_.push(b);
        if (third == 0 || third == 15) vertices_.push(c);
        return {a, b, c};
    }
};

} // namespace

void decode_triangles(const Place& place, const MeshoptLayout& layout, Bytes stream,
                      std::span<unsigned char> target) {
    ByteReader whole(stream, place);
    if (whole.byte() != triangles_header) whole.refuse("has no header of meshopt's triangles");
    const std::size_t triangles = layout.count / 3;
    if (whole.left() < triangles + table_bytes) whole.refuse("ends too early");
    const std::size_t numbers = whole.left() - triangles - table_bytes;
    TriangleDecoder decoder(ByteReader(stream.subspan(1, triangles), place),
                            ByteReader(stream.subspan(1 + triangles, numbers), place),
                            stream.last(table_bytes));
    IndexWriter writer(layout.stride, target);
    for (std::size_t i = 0; i < triangles; ++i) decoder.triangle(writer);
    if (decoder.left() != 0) whole.refuse("holds more than its triangles");
}

void decode_indices(const Place& place, const MeshoptLayout& layout, Bytes stream,
                    std::span<unsigned char> target) {
    ByteReader whole(stream, place);
    if (whole.byte() != indices_header) whole.refuse("has no header of meshopt's indices");
    if (whole.left() < padding_bytes) whole.refuse("ends too early");
    ByteReader reader(stream.subspan(1, whole.left() - padding_bytes), place);
    IndexWriter writer(layout.stride, target);
    std::array<std::uint32_t, 2> last{};
    for (std::size_t i = 0; i < layout.count; ++i) {
        const std::uint32_t code = reader.number();
        std::uint32_t& base = last.at(code & 1U);
        base += unzigzagged(code >> 1U);
        writer.put(base);
    }
    if (reader.left() != 0) reader.refuse("holds more than its indices");
}

} // namespace shadowproof::meshopt
