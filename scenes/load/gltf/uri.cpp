#include "scenes/load/gltf/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace shadowproof::gltf {

namespace {

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/// RFC 3986, section 2.1. Nothing where an escape is malformed or stands for a NUL.
std::optional<std::string> percent_decoded(const std::string& text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            result += text[i];
            continue;
        }
        if (i + 2 >= text.size()) return std::nullopt;
        const int high = hex_digit(text[i + 1]);
        const int low = hex_digit(text[i + 2]);
        if (high < 0 || low < 0) return std::nullopt;
        result += static_cast<char>(high * 16 + low);
        i += 2;
    }
    if (result.find('\0') != std::string::npos) return std::nullopt;
    return result;
}

bool lies_inside(const std::filesystem::path& folder, const std::filesystem::path& path) {
    const auto parts = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return parts.first == folder.end() && parts.second != path.end();
}

} // namespace

std::filesystem::path resolve_uri(const std::filesystem::path& folder, const std::string& uri,
                                  const Place& place) {
    const auto decoded = percent_decoded(uri);
    if (!decoded || decoded->empty())
        place.refuse("is not a well-formed URI", "write a relative path, percent-encoded");
    const std::filesystem::path relative = *decoded;
    if (relative.is_absolute() || uri.substr(0, uri.find('/')).find(':') != std::string::npos)
        place.refuse(fmt::format("\"{}\" is not relative to the asset's folder", uri),
                     "put the file beside the asset");
    std::error_code failure;
    const auto root =
        std::filesystem::canonical(folder.empty() ? std::filesystem::path(".") : folder, failure);
    const auto path = failure ? root : std::filesystem::weakly_canonical(root / relative, failure);
    if (failure) place.refuse(fmt::format("\"{}\": {}", uri, failure.message()), "mend the path");
    if (!lies_inside(root, path))
        place.refuse(fmt::format("\"{}\" leaves the asset's folder", uri),
                     "put the file inside the folder");
    return path;
}

std::string_view base64_digits(const std::string& uri, const Place& place) {
    constexpr std::string_view marker = ";base64,";
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos || !std::string_view(uri).substr(0, comma + 1).ends_with(marker))
        place.refuse("is a data URI that is not base64", "encode it as base64");
    const std::string_view text = std::string_view(uri).substr(comma + 1);
    const std::size_t end = std::min(text.find_first_not_of(digits), text.size());
    // tinygltf stops at the first character that is not a digit, as if the text ended there.
    if (text.size() % 4 != 0 || text.size() - end > 2 ||
        text.find_first_not_of('=', end) != std::string_view::npos)
        place.refuse("is not well-formed base64", "export the asset again");
    return text.substr(0, end);
}

} // namespace shadowproof::gltf
