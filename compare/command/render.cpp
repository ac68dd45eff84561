#include "compare/command/commands.h"
#include "compare/command/console.h"
#include "compare/command/truth_exr.h"
#include "compare/memory.h"
#include "compare/png.h"
#include "compare/write_file.h"
#include "scenes/catalog.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>

namespace shadowproof {

namespace {

struct RenderOptions {
    std::string scene;
    SceneOptions picture;
    std::string output;
    bool quiet = false;
};

/// ".EXR" and ".exr" are one.
std::string extension_of(const std::string& file) {
    std::string extension = std::filesystem::path(file).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

int render_truth(const RenderOptions& options) {
    Console console(options.quiet);
    check_writable(options.output);
    refuse_too_large(options.picture.size.width, options.picture.size.height, truth_bytes());
    const Scene scene = load_scene(options.scene, options.picture.request());
    for (const std::string& note : scene.notes) console.line("note: " + note);
    const GroundTruth truth = trace(Tracer(scene, options.picture.threads));
    if (extension_of(options.output) == ".exr") {
        write_truth_exr(scene, truth, options.output);
    } else {
        write_beside(options.output, [&](const std::filesystem::path& beside) {
            write_png(beside, truth.visibility, options.output);
        });
    }
    const TraceStatistics& traced = truth.statistics;
    console.line(fmt::format("{}: lit {}, shadowed {}, background {}  {:.1f} ms", options.output,
                             grouped(traced.lit), grouped(traced.shadowed),
                             grouped(traced.background), traced.milliseconds));
    return exit_passed;
}

} // namespace

Work add_render(CLI::App& app) {
    CLI::App* command = app.add_subcommand("render", "The truth as a picture");
    const auto options = std::make_shared<RenderOptions>();
    command->add_option("SCENE", options->scene, "A bundled name, or a path to .gltf or .glb")
        ->required()
        ->check(not_empty());
    command
        ->add_option("-o,--output", options->output,
                     ".png: the class map (0 background, 64 shadowed, 255 lit); .exr: position, "
                     "normal, depth, visibility, primId and exactness by name")
        ->type_name("FILE")
        ->required()
        ->check([](const std::string& file) {
            const std::string extension = extension_of(file);
            return extension == ".png" || extension == ".exr"
                       ? ""
                       : "'" + file + "' is neither; name a file that ends in .png or .exr";
        });
    add_scene_flags(*command, options->picture);
    command->add_flag("-q,--quiet", options->quiet, "No output but errors");
    return [options] { return render_truth(*options); };
}

} // namespace shadowproof
