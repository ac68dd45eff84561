// Results as bytes, for the way from one process to another of the same program. A structure is
// sent if it has `template <class Archive> void serialize(Archive&, T&)`.
#pragma once

#include <cereal/archives/binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <sstream>
#include <string>

/// Defines serialize for a structure of which all members are sent. They are named in their order:
/// a new one does not compile until it is named as well.
#define SHADOWPROOF_SEND_ALL(Structure, ...)                                                       \
    template <class Archive>                                                                       \
    void serialize(Archive& archive, Structure& structure) {                                       \
        auto& [__VA_ARGS__] = structure;                                                           \
        archive(__VA_ARGS__);                                                                      \
    }

namespace shadowproof {

template <class T>
std::string packed(const T& value) {
    std::ostringstream stream;
    cereal::BinaryOutputArchive archive(stream);
    archive(value);
    return stream.str();
}

template <class T>
T unpacked(const std::string& bytes) {
    std::istringstream stream(bytes);
    cereal::BinaryInputArchive archive(stream);
    T value{};
    archive(value);
    return value;
}

} // namespace shadowproof
