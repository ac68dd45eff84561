#include "compare/report/report_files.h"

#include "compare/output/descriptor.h"
#include "compare/report/png.h"
#include "compare/report/report.h"
#include "compare/report/shared_files.h"

#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

namespace shadowproof {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view script_end = "});"; ///< as compare/report/report_data.cpp writes it

std::string bytes_of(const fs::path& file) {
    std::string bytes;
    read_pieces(fs::canonical(file), [&](std::string_view piece) { bytes += piece; });
    return bytes;
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

std::optional<std::string> take_over(const ReportFile& file, const ReportFolder& report,
                                     const MemoryAccount& memory) {
    std::error_code ignored;
    if (!fs::is_regular_file(file.from, ignored)) return "is missing";
    const std::uint64_t size = fs::file_size(file.from, ignored);
    memory.require({ignored ? 0 : 3 * size, file.from.string(), "its bytes", "leave it out"});
    memory.require({file.opening.empty() ? 3 * file.width * file.height + size : 0,
                    file.from.string(), "its pixels", "leave it out"});
    std::string bytes;
    try {
        bytes = bytes_of(file.from);
    } catch (const std::system_error& error) {
        return "cannot be read (" + error.code().message() + ")";
    }
    if (file.opening.empty()) {
        if (file.place != nullptr)
            *file.place = report.add_picture(file.to, bytes);
        else
            report.add_file(file.to, bytes);
        return png_damage(bytes, file.width, file.height);
    }
    std::optional<std::string> damage = script_damage(file, bytes);
    if (!damage) {
        bytes.replace(0, file.opening.size(), file.new_opening);
        bytes = with_own_blocks(bytes, [&](const std::string& technique) {
            const fs::path other = file.from.parent_path() / (technique + ".cell.js");
            try {
                return bytes_of(other);
            } catch (const std::system_error&) {
                return std::string();
            }
        });
        if (std::string lacking = lacking_blocks(bytes); !lacking.empty())
            damage = std::move(lacking);
    }
    if (file.of_cell)
        report.add_script(file.to, bytes);
    else
        report.add_file(file.to, bytes);
    return damage;
}

} // namespace shadowproof
