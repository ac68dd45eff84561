// A file of JSON as a stream of bytes that a parser of nlohmann's reads, without holding it.
#pragma once

#include "compare/json/json_file.h"
#include "compare/output/descriptor.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

namespace shadowproof {

/// The bytes of an open regular file, in turn. Throws Error naming the file.
class JsonBytes {
public:
    JsonBytes(const std::filesystem::path& file, const JsonRemedies& remedies);

    bool at_end();
    char current() const { return buffer_[at_]; }
    void advance() { ++at_; }
    /// How many bytes were passed.
    std::uint64_t passed() const { return before_ + at_; }
    std::uint64_t size() const { return size_; }

    /// Called before each further piece of the file is read; it may throw.
    std::function<void()> before_reading{};

private:
    std::filesystem::path file_;
    JsonRemedies remedies_;
    Descriptor opened_;
    std::uint64_t size_ = 0;
    std::vector<char> buffer_;
    std::size_t at_ = 0;
    std::size_t held_ = 0;
    std::uint64_t before_ = 0; ///< bytes of the file before the buffer
};

/// Bytes `begin` to `end` of a file, fewer where it ends. Throws Error naming it.
std::string json_slice(const std::filesystem::path& file, std::uint64_t begin, std::uint64_t end,
                       const JsonRemedies& remedies);

/// An input iterator over JsonBytes; the default one is the end.
class JsonByte {
public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = char;

    JsonByte() = default;
    explicit JsonByte(JsonBytes& bytes) : bytes_(&bytes) {}

    char operator*() const { return bytes_->current(); }
    JsonByte& operator++() {
        bytes_->advance();
        return *this;
    }
    void operator++(int) { ++*this; }
    bool operator==(const JsonByte& other) const { return is_end() == other.is_end(); }

private:
    JsonBytes* bytes_ = nullptr;

    bool is_end() const { return bytes_ == nullptr || bytes_->at_end(); }
};

} // namespace shadowproof
