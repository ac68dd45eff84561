#include "compare/command/commands.h"
#include "compare/command/guard.h"
#include "compare/command/output_files.h"
#include "compare/command/process/console.h"
#include "compare/command/process/exit_code.h"
#include "compare/command/scene_result.h"
#include "compare/command/truth_exr.h"
#include "compare/memory.h"
#include "compare/output/write_file.h"
#include "compare/report/color_picture.h"
#include "compare/report/png.h"
#include "scenes/error.h"
#include "scenes/load/catalog.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>

namespace shadowproof {

namespace {

struct RenderOptions {
    std::string scene;
    SceneOptions picture;
    std::string output;
    std::string aov;      ///< of a PNG; empty: visibility
    int samples = 1;      ///< along each side of a pixel
    double timeout = 600; ///< seconds; 0: any number
    bool quiet = false;
};

bool is_exr(const RenderOptions& options) {
    return extension_of(options.output) == ".exr";
}

/// Whether a .png shows another term of lighting than the colour.
bool wants_terms(const RenderOptions& options) {
    return !options.aov.empty() && options.aov != "visibility" && options.aov != "color";
}

/// Whether lighting is requested, and the message if there is none.
bool wants_lighting(const RenderOptions& options, const Scene& scene) {
    const bool asked = options.aov == "color" || wants_terms(options);
    if (asked && !is_bump_lit(scene))
        throw Error(scene.file.string(), "has no bump map, so its colours are not judged",
                    "render --aov visibility, or give a material a normalTexture");
    return asked || (is_exr(options) && is_bump_lit(scene));
}

Workload work_of(const RenderOptions& options, bool lit) {
    if (is_exr(options)) return lit ? Workload::lit_truth : Workload::truth;
    if (wants_terms(options)) return Workload::terms;
    return lit ? Workload::colors : Workload::class_map;
}

Image<Rgb> lit_picture(const RenderOptions& options, const Tracer& tracer,
                       const GroundTruth& truth) {
    if (options.aov == "normal") return normal_picture(shade_terms(tracer, truth));
    if (options.aov == "tangent") return tangent_picture(shade_terms(tracer, truth));
    if (options.aov == "light")
        return tangent_space_picture(shade_terms(tracer, truth), &Shading::to_light);
    if (options.aov == "half_angle")
        return tangent_space_picture(shade_terms(tracer, truth), &Shading::half);
    const TracedLights before = trace_lights_before(tracer);
    return color_picture(options.samples > 1
                             ? shade_supersampled(tracer, options.samples, before).color
                             : shade(tracer, truth, before));
}

void write_truth(const RenderOptions& options, const Tracer& tracer, const GroundTruth& truth) {
    const bool lit = wants_lighting(options, tracer.scene());
    if (is_exr(options))
        return write_truth_exr(tracer.scene(), truth,
                               lit ? shade_terms(tracer, truth, trace_lights_before(tracer))
                                   : Image<Shading>(),
                               options.output);
    write_file(options.output,
               lit ? to_png(lit_picture(options, tracer, truth)) : to_png(truth.visibility));
}

int render_truth(const RenderOptions& options, int watcher) {
    Console console(options.quiet, watcher);
    check_writable(options.output);
    check_apart(std::array{options.output}, std::array{options.scene});
    require_picture(options.picture.memory, options.picture.size.width, options.picture.size.height,
                    work_of(options, false));
    console.progress(options.scene + ": reading");
    const Scene scene = load_scene(options.scene, options.picture.request());
    for (const std::string& note : scene.notes) console.line("note: " + note);
    if (const auto note = note_on_added_lights(scene); note && wants_lighting(options, scene))
        console.line("note: " + *note);
    require_scene(options.picture.memory, scene, work_of(options, wants_lighting(options, scene)));
    console.progress(options.scene + ": tracing");
    const Tracer tracer(scene, options.picture.threads);
    const GroundTruth truth = trace(tracer);
    console.progress(options.scene + ": writing " + options.output);
    write_truth(options, tracer, truth);
    const TraceStatistics& traced = truth.statistics;
    console.line(fmt::format("{}: lit {}, shadowed {}, background {}  {:.1f} ms", options.output,
                             grouped(traced.lit), grouped(traced.shadowed),
                             grouped(traced.background), traced.milliseconds));
    return exit_passed;
}

/// Checks that involve several options, which CLI11 does not make.
void check_together(const RenderOptions& options) {
    if (!options.aov.empty() && is_exr(options))
        throw CLI::ValidationError("--aov", "an .exr holds them all; name a .png, or leave it out");
    if (options.samples > 1 && options.aov != "color")
        throw CLI::ValidationError("--samples", "is for --aov color");
}

} // namespace

Work add_render(CLI::App& app) {
    CLI::App* command = app.add_subcommand("render", "The truth as a picture");
    const auto options = std::make_shared<RenderOptions>();
    add_scene_argument(*command, options->scene);
    command
        ->add_option("-o,--output", options->output,
                     ".png: the class map (0 background, 64 shadowed, 255 lit), or what --aov "
                     "says; .exr: position, normal, depth, visibility, primId and exactness by "
                     "name, and colours where the scene has bump maps")
        ->type_name("FILE")
        ->required()
        ->check([](const std::string& file) {
            const std::string extension = extension_of(file);
            return extension == ".png" || extension == ".exr"
                       ? ""
                       : "'" + file + "' is neither; name a file that ends in .png or .exr";
        });
    command
        ->add_option(
            "--aov", options->aov,
            "What a .png shows: visibility (the class map), or, of scenes with bump maps, "
            "color (sRGB), normal (the bumped ones, world space), tangent (likewise), light "
            "or half_angle (the unit vectors L and H, tangent space)")
        ->type_name("NAME")
        ->check(CLI::IsMember({"visibility", "color", "normal", "tangent", "light", "half_angle"}));
    command
        ->add_option("--samples", options->samples,
                     "Rays along each side of a pixel, 1 to 32, whose mean is its colour (1)")
        ->type_name("N")
        ->check(CLI::Range(1, 32));
    add_scene_flags(*command, options->picture);
    add_timeout_flag(*command, options->timeout,
                     "Seconds above which it is given up (600; 0: any number)");
    command->final_callback([options] { check_together(*options); });
    command->add_flag("-q,--quiet", options->quiet, "No output but errors");
    return [options] {
        return guarded_within(options->timeout, options->scene,
                              [&](int watcher) { return render_truth(*options, watcher); });
    };
}

} // namespace shadowproof
