#include "scenes/error.h"
#include "scenes/gltf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

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

/// 0..63, or -1.
int base64_digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+') return 62;
    if (c == '/') return 63;
    return -1;
}

} // namespace

std::filesystem::path resolve_uri(const std::filesystem::path& folder, const Item& uri) {
    const std::string text = uri.text();
    const auto decoded = percent_decoded(text);
    if (!decoded || decoded->empty())
        uri.refuse("is not a well-formed URI", "write a relative path, percent-encoded");
    const std::filesystem::path relative = *decoded;
    if (relative.is_absolute() || text.substr(0, text.find('/')).find(':') != std::string::npos)
        uri.refuse(fmt::format("\"{}\" is not relative to the asset's folder", text),
                   "put the file beside the asset");
    std::error_code failure;
    const auto root =
        std::filesystem::canonical(folder.empty() ? std::filesystem::path(".") : folder, failure);
    const auto place = failure ? root : std::filesystem::weakly_canonical(root / relative, failure);
    if (failure) uri.refuse(fmt::format("\"{}\": {}", text, failure.message()), "mend the path");
    if (!lies_inside(root, place))
        uri.refuse(fmt::format("\"{}\" leaves the asset's folder", text),
                   "put the file inside the folder");
    return place;
}

std::optional<std::vector<std::byte>> decode_base64(std::string_view text) {
    if (text.size() % 4 != 0) return std::nullopt;
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3);
    for (std::size_t i = 0; i < text.size(); i += 4) {
        const bool last = i + 4 == text.size();
        const std::size_t padding = last && text[i + 3] == '=' ? (text[i + 2] == '=' ? 2 : 1) : 0;
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const int digit = k >= 4 - padding ? 0 : base64_digit(text[i + k]);
            if (digit < 0) return std::nullopt;
            group = group << 6U | static_cast<std::uint32_t>(digit);
        }
        for (std::size_t k = 0; k < 3 - padding; ++k)
            bytes.push_back(static_cast<std::byte>(group >> (16 - 8 * k) & 0xffU));
    }
    return bytes;
}

} // namespace shadowproof::gltf
