#include "compare/report_files.h"

#include "compare/png.h"
#include "compare/report.h"
#include "compare/write_file.h"

#include <fstream>
#include <iterator>

namespace shadowproof {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view script_end = "});"; ///< as compare/report_data.cpp writes it

std::string bytes_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::optional<std::string> script_damage(const ReportFile& file, std::string_view text) {
    if (!text.starts_with(file.opening))
        return "is damaged: it does not begin with " + file.opening;
    const std::size_t last = text.find_last_not_of("\r\n");
    if (last == std::string_view::npos || !text.substr(0, last + 1).ends_with(script_end))
        return "is damaged: its end is missing";
    return std::nullopt;
}

} // namespace

std::optional<std::string> take_over(const ReportFile& file, const fs::path& folder) {
    std::error_code ignored;
    if (!fs::is_regular_file(file.from, ignored)) return "is missing";
    const fs::path to = folder / file.to;
    fs::create_directories(to.parent_path());
    std::string bytes = bytes_of(file.from);
    if (file.opening.empty()) {
        write_file(to, bytes);
        return png_damage(to, file.width, file.height);
    }
    const std::optional<std::string> damage = script_damage(file, bytes);
    if (!damage) bytes.replace(0, file.opening.size(), file.new_opening);
    write_file(to, bytes);
    return damage;
}

} // namespace shadowproof
