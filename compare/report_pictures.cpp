#include "compare/report_pictures.h"

#include "compare/report_data.h"
#include "scenes/error.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace shadowproof {

namespace {

void write_png_bytes(const std::filesystem::path& file, int width, int height, int channels,
                     const void* bytes) {
    OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
    // These pictures are long runs of few values: level 1 is as small as need be, and quick.
    spec.attribute("png:compressionLevel", 1);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("png");
    const auto fail = [&](const std::string& reason) {
        throw Error(file.string(), "the picture cannot be written (" + reason + ")",
                    "see that its folder is writable and has room");
    };
    if (!output) fail(OIIO::geterror());
    if (!output->open(file.string(), spec) || !output->write_image(OIIO::TypeDesc::UINT8, bytes) ||
        !output->close())
        fail(output->geterror());
}

template <class Color>
Image<Rgb> marked(const Cell& cell, Color color) {
    const Image<Visibility>& claim = cell.frame.claim;
    const Image<std::uint8_t>& cause = cell.comparison.cause;
    Image<Rgb> picture(claim.width, claim.height);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        picture.pixels[i] = cause.pixels[i] == no_difference ? dimmed(claim.pixels[i]) : color(i);
    return picture;
}

/// Runs all jobs; throws what the first that failed threw.
void run_all(const std::vector<std::function<void()>>& jobs, int threads) {
    std::atomic<std::size_t> next = 0;
    std::mutex guard;
    std::exception_ptr failure;
    const auto work = [&] {
        for (std::size_t i = next++; i < jobs.size(); i = next++) {
            try {
                jobs[i]();
            } catch (...) {
                const std::lock_guard lock(guard);
                if (!failure) failure = std::current_exception();
            }
        }
    };
    const std::size_t wanted =
        threads > 0 ? static_cast<std::size_t>(threads) : std::thread::hardware_concurrency();
    {
        std::vector<std::jthread> others;
        for (std::size_t i = 1; i < std::min(wanted, jobs.size()); ++i) others.emplace_back(work);
        work();
    }
    if (failure) std::rethrow_exception(failure);
}

} // namespace

std::string folder_of(const SceneResult& scene) {
    std::string folder = scene.folder.empty() ? scene.name : scene.folder;
    for (char& c : folder) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           (c >= '0' && c <= '9') || c == '-' || c == '_';
        if (!plain) c = '_';
    }
    return folder.empty() ? "scene" : folder;
}

std::string picture_path(const SceneResult& scene, const Cell& cell, const std::string& kind) {
    return folder_of(scene) + "/" + cell.technique + "/" + kind + ".png";
}

std::string truth_path(const SceneResult& scene) {
    return folder_of(scene) + "/truth.png";
}

Image<Rgb> difference_picture(const GroundTruth& truth, const Cell& cell) {
    return marked(cell, [&](std::size_t i) {
        const Contradiction found =
            contradiction(truth.visibility.pixels[i], cell.frame.claim.pixels[i]);
        return all_contradictions[static_cast<std::size_t>(found)].color;
    });
}

Image<Rgb> cause_picture(const Cell& cell) {
    return marked(cell,
                  [&](std::size_t i) { return cause_colors[cell.comparison.cause.pixels[i]]; });
}

void write_png(const std::filesystem::path& file, const Image<Visibility>& classes) {
    write_png_bytes(file, classes.width, classes.height, 1, classes.pixels.data());
}

void write_png(const std::filesystem::path& file, const Image<Rgb>& picture) {
    write_png_bytes(file, picture.width, picture.height, 3, picture.pixels.data());
}

void write_pictures(const SceneResult& scene, const std::filesystem::path& report, int threads) {
    if (!scene.error.empty()) return;
    std::vector<std::function<void()>> jobs;
    std::filesystem::create_directories((report / truth_path(scene)).parent_path());
    jobs.emplace_back([&] { write_png(report / truth_path(scene), scene.truth.visibility); });
    jobs.emplace_back(
        [&] { write_file(report / folder_of(scene) / "scene.js", scene_script(scene)); });
    for (const Cell& cell : scene.cells) {
        if (!cell.error.empty()) continue;
        const auto path = [&](const char* kind) {
            return report / picture_path(scene, cell, kind);
        };
        const std::filesystem::path folder = path("claim").parent_path();
        std::filesystem::create_directories(folder);
        jobs.emplace_back([&scene, &cell, file = folder / "cell.js"] {
            write_file(file, cell_script(scene, cell));
        });
        jobs.emplace_back([&cell, file = path("claim")] { write_png(file, cell.frame.claim); });
        jobs.emplace_back([&scene, &cell, file = path("difference")] {
            write_png(file, difference_picture(scene.truth, cell));
        });
        jobs.emplace_back([&cell, file = path("cause")] { write_png(file, cause_picture(cell)); });
    }
    run_all(jobs, threads);
}

} // namespace shadowproof
