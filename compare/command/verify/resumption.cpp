#include "compare/command/verify/resumption.h"

#include "compare/command/scene_result.h"
#include "compare/command/verify/planning.h"
#include "scenes/error.h"
#include "scenes/load/catalog.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace shadowproof {

void require_same_driver(const WorkerSetup& setup, const DriverInfo& driver) {
    const std::string words =
        fmt::format("{}, {}, Embree {}", driver.renderer, driver.version, embree_version());
    const std::string begun = setup.pieces.piece("the driver", [&] { return words; });
    if (begun != words)
        throw Error(setup.options.output.out,
                    fmt::format("cannot be gone on with: it was begun with {}, and this is {}",
                                begun, words),
                    "leave out --resume, and all is tried anew");
}

void require_same_scene(const WorkerSetup& setup, const std::string& argument,
                        std::span<const SceneResult> results) {
    std::vector<std::string> contents; // under each of its lights
    setup.pieces.step(argument + ": reading again", [&] {
        const SceneRequest request = request_of(setup.options);
        Scene scene = load_scene(argument, request);
        const std::size_t lights = request.every_light ? scene.lights.size() : 1;
        for (std::size_t i = 0; i < lights; ++i) {
            if (lights > 1) scene.light = i;
            contents.push_back(content_of(scene));
        }
    });
    for (const SceneResult& result : results)
        if (std::ranges::find(contents, content_of(result)) == contents.end())
            refuse_changed(argument);
}

void recall(const WorkerSetup& setup, const SceneResult& scene, const Cell& cell) {
    try {
        setup.folder.recall_cell(scene, cell);
    } catch (const Error&) {
        throw Error(setup.options.output.out,
                    fmt::format("cannot be gone on with: files of {} on {} are missing",
                                cell.technique, scene.name),
                    "leave out --resume, and all is tried anew");
    }
}

void refuse_changed(const std::string& argument) {
    throw Error(argument, "is another scene than the run that was cut off has tried",
                "leave out --resume, and all is tried anew");
}

} // namespace shadowproof
