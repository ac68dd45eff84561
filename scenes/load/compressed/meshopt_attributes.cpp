#include "scenes/load/compressed/meshopt_parts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <vector>

namespace shadowproof::meshopt {

namespace {

constexpr std::size_t group = 16; ///< elements whose differences share a width in bits
constexpr std::uint8_t version_0 = 0xa0;
constexpr std::uint8_t version_1 = 0xa1;
constexpr std::size_t tail_of_version_0 = 32; ///< bytes at the end, at least
constexpr std::size_t tail_of_version_1 = 24;

/// How the four bytes of a channel are put together (version 1; version 0 knows bytes only).
enum class Channel : std::uint8_t { bytes, words, rotated_xor };

/// What a stream says of itself, and the element that comes before the next.
struct State {
    const MeshoptLayout& layout;
    bool is_version_1 = false;
    std::vector<unsigned char> element;  ///< stride bytes
    std::vector<unsigned char> channels; ///< one per four bytes; empty in version 0
};

/// Elements of a block: as many groups as fit 8 KB, at most 256 elements.
std::size_t block_size(std::size_t stride) {
    return std::min<std::size_t>(8192 / stride & ~(group - 1), 256);
}

/// 16 differences of `bits` each, highest bits of a byte first, but single bits lowest first. The
/// largest number says that a whole byte follows.
void read_packed(ByteReader& reader, unsigned bits, unsigned char* deltas) {
    const Bytes packed = reader.take(group * bits / 8);
    const unsigned per_byte = 8 / bits;
    const unsigned sentinel = (1U << bits) - 1;
    for (std::size_t i = 0; i < group; ++i) {
        const auto place = static_cast<unsigned>(i % per_byte);
        const unsigned shift = bits == 1 ? place : 8 - bits * (place + 1);
        const unsigned value = packed[i / per_byte] >> shift & sentinel;
        deltas[i] = value == sentinel ? reader.byte() : static_cast<unsigned char>(value);
    }
}

/// The differences of one byte of the elements of a block, in groups of 16. `widths` are the bits
/// that each of the four codes in the header stands for.
void read_groups(ByteReader& reader, const std::array<unsigned, 4>& widths, std::size_t groups,
                 unsigned char* deltas) {
    const Bytes header = reader.take((groups + 3) / 4);
    for (std::size_t i = 0; i < groups; ++i) {
        unsigned char* const first = deltas + i * group;
        const unsigned bits = widths.at(header[i / 4] >> (i % 4 * 2) & 3U);
        if (bits == 0)
            std::fill_n(first, group, static_cast<unsigned char>(0));
        else if (bits == 8)
            std::ranges::copy(reader.take(group), first);
        else
            read_packed(reader, bits, first);
    }
}

/// One byte's differences for all `count` elements of a block.
void read_deltas(ByteReader& reader, const State& state, unsigned control, std::size_t count,
                 unsigned char* deltas) {
    constexpr std::array<std::array<unsigned, 4>, 3> widths{
        {{0, 2, 4, 8}, {0, 1, 2, 4}, {1, 2, 4, 8}}};
    const std::size_t groups = (count + group - 1) / group;
    if (!state.is_version_1) return read_groups(reader, widths[0], groups, deltas);
    if (control == 2) return void(std::fill_n(deltas, count, static_cast<unsigned char>(0)));
    if (control == 3) return void(std::ranges::copy(reader.take(count), deltas));
    read_groups(reader, widths.at(control + 1), groups, deltas);
}

template <class T>
T assembled(const std::array<unsigned char, 4>& bytes, std::size_t first) {
    T value{};
    std::memcpy(&value, bytes.data() + first, sizeof value);
    return value;
}

/// Adds zigzag differences of the width of T to four bytes of an element.
template <class T>
void add(const std::array<unsigned char, 4>& deltas, unsigned char* element) {
    for (std::size_t k = 0; k < 4; k += sizeof(T)) {
        T value{};
        std::memcpy(&value, element + k, sizeof value);
        value = static_cast<T>(value + unzigzagged(assembled<T>(deltas, k)));
        std::memcpy(element + k, &value, sizeof value);
    }
}

/// Moves four bytes of the element on to the next one's.
void advance(const State& state, std::size_t channel, const std::array<unsigned char, 4>& deltas,
             unsigned char* element) {
    const unsigned code = state.is_version_1 ? state.channels[channel] : 0;
    switch (static_cast<Channel>(code & 3U)) {
    case Channel::bytes:
        return add<std::uint8_t>(deltas, element);
    case Channel::words:
        return add<std::uint16_t>(deltas, element);
    case Channel::rotated_xor:
        break;
    }
    std::uint32_t value{};
    std::memcpy(&value, element, sizeof value);
    value ^= std::rotr(assembled<std::uint32_t>(deltas, 0), static_cast<int>(code >> 4U));
    std::memcpy(element, &value, sizeof value);
}

/// `deltas`: room for the differences of a block, byte by byte.
void decode_block(ByteReader& reader, State& state, std::vector<unsigned char>& deltas,
                  std::span<unsigned char> target) {
    const std::size_t stride = state.layout.stride;
    const std::size_t count = target.size() / stride;
    const std::size_t room = block_size(stride);
    const Bytes control = reader.take(state.is_version_1 ? stride / 4 : 0);
    for (std::size_t k = 0; k < stride; ++k) {
        const unsigned code = state.is_version_1 ? control[k / 4] >> (k % 4 * 2) & 3U : 0U;
        read_deltas(reader, state, code, count, deltas.data() + k * room);
    }
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < stride; k += 4) {
            const unsigned char* const first = deltas.data() + k * room + i;
            advance(state, k / 4, {first[0], first[room], first[2 * room], first[3 * room]},
                    state.element.data() + k);
        }
        std::ranges::copy(state.element, target.data() + i * stride);
    }
}

} // namespace

void decode_attributes(const Place& place, const MeshoptLayout& layout, Bytes stream,
                       std::span<unsigned char> target) {
    const std::size_t stride = layout.stride;
    ByteReader whole(stream, place);
    const std::uint8_t version = whole.byte();
    if (version != version_0 && version != version_1)
        whole.refuse("has no header of meshopt's attributes");
    State state{layout, version == version_1, {}, {}};
    const std::size_t tail = state.is_version_1 ? stride + stride / 4 : stride;
    const std::size_t padded =
        std::max(tail, state.is_version_1 ? tail_of_version_1 : tail_of_version_0);
    if (whole.left() < padded) whole.refuse("ends too early");
    const Bytes end = stream.last(tail);
    state.element.assign(end.begin(), end.begin() + static_cast<std::ptrdiff_t>(stride));
    state.channels.assign(end.begin() + static_cast<std::ptrdiff_t>(stride), end.end());
    for (const unsigned char channel : state.channels)
        if ((channel & 3U) == 3) whole.refuse("has a channel of no known kind");
    ByteReader reader(stream.subspan(1, stream.size() - 1 - padded), place);
    std::vector<unsigned char> deltas(block_size(stride) * stride);
    for (std::size_t at = 0; at < target.size();) {
        const std::size_t bytes = std::min(target.size() - at, block_size(stride) * stride);
        decode_block(reader, state, deltas, target.subspan(at, bytes));
        at += bytes;
    }
    if (reader.left() != 0) reader.refuse("holds more than its elements");
}

} // namespace shadowproof::meshopt
