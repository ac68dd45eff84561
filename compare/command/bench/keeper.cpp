#include "compare/command/bench/keeper.h"

#include "compare/bench/bench_file.h"
#include "compare/bench/bench_json.h"
#include "compare/bench/kept.h"
#include "compare/output/write_file.h"
#include "scenes/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace shadowproof {

BenchKeeper::BenchKeeper(const std::string& file, const BenchRun* earlier)
    : file_(!file.empty() && is_replaced(file) ? file : std::string()), earlier_(earlier) {}

void BenchKeeper::keep(const BenchRun& run) {
    constexpr double pause = 3000; // milliseconds; writing a file to disk may take some of them
    if (file_.empty() || (since_ && since_->milliseconds() < pause)) return;
    write_file(file_, results_text(bench_json(
                          with_kept(run, earlier_ != nullptr ? *earlier_ : BenchRun()))));
    since_.emplace();
}

std::optional<BenchRun> kept_run(const std::string& file, MemoryAccount& memory) {
    std::error_code failure;
    using std::filesystem::file_type;
    if (std::filesystem::symlink_status(file, failure).type() == file_type::not_found)
        return std::nullopt;
    return read_bench(file, &memory);
}

void require_same_settings(const std::string& file, const BenchRun& kept, const BenchRun& now) {
    const auto require_same = [&](const char* what, const std::string& was, const std::string& is) {
        if (was != is)
            throw Error(file,
                        fmt::format("cannot be gone on with: its {} is {}, and now {}", what,
                                    was.empty() ? "none" : was, is.empty() ? "none" : is),
                        "leave out --resume, or name another file with --json");
    };
    require_same("version", kept.version, now.version);
    require_same("driver", kept.gl.renderer + ", " + kept.gl.version,
                 now.gl.renderer + ", " + now.gl.version);
    require_same("Embree", kept.embree, now.embree);
    require_same("processor", kept.machine.processor, now.machine.processor);
    require_same("number of cores", fmt::format("{}", kept.machine.cores),
                 fmt::format("{}", now.machine.cores));
    require_same("setting", fmt::format("{}", fmt::join(kept.arguments, " ")),
                 fmt::format("{}", fmt::join(now.arguments, " ")));
}

const BenchScene* kept_scene(const std::string& file, const BenchRun& kept, const BenchScene& now) {
    const auto found = std::ranges::find(kept.scenes, now.name, &BenchScene::name);
    if (found == kept.scenes.end()) return nullptr;
    if (!are_one_picture(*found, now))
        throw Error(file,
                    fmt::format("cannot be gone on with: the content, size or light of its scene "
                                "{} is not that of {}",
                                now.name, now.file),
                    "leave out --resume, or name another file with --json");
    return &*found;
}

} // namespace shadowproof
