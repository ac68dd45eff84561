#include "compare/command/bench/pictures.h"

#include "compare/command/point_pictures.h"
#include "compare/output/manifest.h"
#include "compare/report/report_page.h"
#include "scenes/load/common/file_bytes.h"

#include <filesystem>
#include <set>
#include <string_view>
#include <system_error>

namespace shadowproof {

namespace fs = std::filesystem;

void take_over_pictures(const std::string& from, const MemoryAccount& memory, BenchRun& run,
                        const ReplacedFolder& folder, bool wanted) {
    const fs::path given = fs::absolute(from);
    const fs::path older = given.filename() == results_name ? given.parent_path() : given;
    const FolderPart part{folder, std::string(pictures_folder) + "/"};
    std::set<std::string> taken;
    const Manifest written =
        wanted && fs::is_directory(older) ? read_manifest(older).value_or(Manifest()) : Manifest();
    for (const auto& [name, fingerprint] : written) {
        if (!name.starts_with(part.below) || name == part.below + page_name) continue;
        std::error_code failure;
        if (!fs::is_regular_file(fs::symlink_status(older / name, failure))) continue;
        const FileBytes bytes = read_bytes(older / name, Place((older / name).string()), memory);
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        if (fingerprint_of(text) != fingerprint) continue;
        folder.add(name, text);
        taken.insert(name.substr(part.below.size()));
    }
    const bool whole = taken.contains(results_name) && taken.contains(results_script_name);
    if (whole) part.add(page_name, report_page());
    const std::string page = part.below + page_name + "#";
    for (BenchPoint& point : run.points)
        if (!whole || point.pictures.size() < page.size() ||
            !taken.contains(point.pictures.substr(page.size()) + ".cell.js"))
            point.pictures.clear();
}

} // namespace shadowproof
