#include "compare/json/json_file.h"

#include "compare/output/descriptor.h"
#include "scenes/error.h"
#include "scenes/load/gltf/memory.h"

#include <fmt/format.h>

#include <string_view>
#include <system_error>

namespace shadowproof {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t largest = std::uint64_t{1} << 30U; // bytes

std::string text_of(const fs::path& file, const JsonRemedies& remedies,
                    const MemoryAccount* memory) {
    const char* const remedy = remedies.name;
    require_json_file(file, remedies);
    std::error_code failure;
    const std::uint64_t size = fs::file_size(file, failure);
    if (failure || size > largest)
        throw Error(file.string(), fmt::format("has more than {} bytes", largest), remedy);
    if (memory != nullptr)
        memory->require({size, file.string(), "its text", "merge fewer runs at once"});
    std::string text;
    text.reserve(size);
    try {
        read_pieces(fs::canonical(file), [&](std::string_view piece) { text += piece; });
    } catch (const std::system_error& error) {
        throw Error(file.string(), fmt::format("cannot be read ({})", error.code().message()),
                    remedy);
    }
    return text;
}

} // namespace

void require_json_file(const fs::path& file, const JsonRemedies& remedies) {
    std::error_code failure;
    if (!fs::exists(file, failure))
        throw Error(file.string(),
                    failure ? fmt::format("cannot be read ({})", failure.message())
                            : "there is no such file",
                    remedies.name);
    if (!fs::is_regular_file(file, failure))
        throw Error(file.string(), "cannot be read (it is not a file)", remedies.name);
}

void throw_not_json(const std::string& file, std::uint64_t size, std::uint64_t byte,
                    const JsonRemedies& remedies) {
    if (size == 0) throw Error(file, "is empty", remedies.whole);
    if (byte > size)
        throw Error(file, fmt::format("is cut off after byte {}", size), remedies.whole);
    throw Error(file, fmt::format("is not JSON at byte {}", byte), remedies.whole);
}

ResultsJson parse_json(const std::string& text, const std::string& file,
                       const JsonRemedies& remedies) {
    const auto not_too_deep = [&](int depth, ResultsJson::parse_event_t, ResultsJson&) {
        if (depth > deepest_json)
            throw Error(file, fmt::format("nests deeper than {}", deepest_json), remedies.whole);
        return true;
    };
    try {
        return ResultsJson::parse(text, not_too_deep);
    } catch (const ResultsJson::parse_error& error) {
        throw_not_json(file, text.size(), error.byte, remedies);
    } catch (const ResultsJson::out_of_range&) {
        throw Error(file, "holds a number beyond every double", remedies.whole);
    }
}

std::string json_text(const fs::path& file, const JsonRemedies& remedies, MemoryAccount* memory) {
    std::string text = text_of(file, remedies, memory);
    // Once as read, once as merged, and as text again.
    if (memory != nullptr)
        memory->keep({2 * gltf::json_bytes(gltf::count_json(text, deepest_json)) + 4 * text.size(),
                      file.string(), "its values", "merge fewer runs at once"});
    return text;
}

std::string results_text(const ResultsJson& results) {
    return results.dump(1, ' ', false, ResultsJson::error_handler_t::replace) + "\n";
}

std::string shown(const ResultsJson& value) {
    constexpr std::size_t longest = 60; // bytes: beside two file names on a line
    std::string text = value.dump(-1, ' ', true, ResultsJson::error_handler_t::replace);
    if (text.size() > longest) text = text.substr(0, longest - 3) + "...";
    return text;
}

} // namespace shadowproof
