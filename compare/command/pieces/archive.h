// Results as bytes, for the way from one process to another of the same program. A structure goes
// where it has `template <class Archive> void serialize(Archive&, T&)`.
#pragma once

#include <cereal/archives/binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <sstream>
#include <string>

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
