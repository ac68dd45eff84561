#include "compare/blank.h"
#include "compare/color_words.h"
#include "compare/command/commands.h"
#include "compare/command/drawing.h"
#include "compare/command/guard.h"
#include "compare/command/output_files.h"
#include "compare/command/standard_output.h"
#include "compare/escape.h"
#include "compare/memory.h"
#include "compare/output/write_file.h"
#include "compare/pixel_record.h"
#include "raster/render.h"
#include "reference/ledger.h"
#include "scenes/admission.h"
#include "scenes/catalog.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>

namespace shadowproof {

namespace {

struct PixelPosition {
    int x = 0;
    int y = 0;
};

struct ExplainOptions {
    std::string scene;
    PixelPosition pixel;
    SceneOptions picture;
    TechniqueOptions technique;
    std::string json;
    std::string svg;
    bool quiet = false;
};

std::string_view name_of(Crossing::Part part) {
    if (part == Crossing::Part::light_cap) return "light cap";
    return part == Crossing::Part::dark_cap ? "dark cap" : "side";
}

std::string mesh_name(const Scene& scene, std::uint32_t triangle) {
    return printable(scene.meshes[mesh_of(scene, triangle)].name);
}

std::string triangle_words(const Scene& scene, std::uint32_t triangle) {
    return fmt::format("triangle {} of {}", triangle, mesh_name(scene, triangle));
}

std::string vector_words(const glm::dvec3& v) {
    return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x, v.y, v.z);
}

PixelPosition parse_pixel(const std::string& text) {
    PixelPosition pixel;
    const char* end = text.data() + text.size();
    const auto x = std::from_chars(text.data(), end, pixel.x);
    const bool separated = x.ec == std::errc() && x.ptr != end && *x.ptr == ',';
    const auto y = separated ? std::from_chars(x.ptr + 1, end, pixel.y) : std::from_chars_result{};
    if (!separated || y.ec != std::errc() || y.ptr != end || pixel.x < 0 || pixel.y < 0)
        throw CLI::ValidationError(
            "--pixel", "'" + text + "' is not a pixel; give X,Y from the top left, as 212,340");
    return pixel;
}

TechniqueAtPixel ask(const Technique& technique, const PixelRecord& record, const Tracer& tracer,
                     const Silhouette& silhouette, const GroundTruth& truth,
                     const ShadowDepths& depths, const Plan& plan, Gpu& gpu) {
    const auto failed = [&](const std::string& why) {
        TechniqueAtPixel at_pixel;
        at_pixel.name = technique.name;
        at_pixel.error = why;
        return at_pixel;
    };
    try {
        const Frame frame = render(technique, tracer.scene(), plan, gpu);
        const Prediction prediction(tracer, silhouette, truth, depths, frame.counting,
                                    frame.depth_model);
        const Comparison comparison =
            classify(tracer, silhouette, truth, depths, frame, prediction);
        refuse_blank(technique.name, truth, frame, comparison);
        TechniqueAtPixel at_pixel =
            technique_at(record, prediction, std::string(technique.name), frame, comparison);
        if (!frame.color.pixels.empty())
            at_pixel.color = account_for_color(tracer, truth, frame, record.x, record.y);
        return at_pixel;
    } catch (const std::bad_alloc&) {
        return failed(std::string(technique.name) + ": " + out_of_memory);
    } catch (const std::runtime_error& error) {
        return failed(error.what());
    }
}

std::string cause_words(const TechniqueAtPixel& technique) {
    return technique.cause == no_difference ? "no difference"
                                            : std::string(all_causes[technique.cause].name);
}

std::string_view loss_words(Tally tally) {
    switch (tally) {
    case Tally::lost_near:
        return "before the near plane";
    case Tally::lost_far:
        return "past the far plane";
    case Tally::lost_cap:
        return "on a missing cap";
    case Tally::counted:
    case Tally::beyond:
        break;
    }
    return {};
}

/// "+1 at 3.2 before the near plane, 2 dark caps past the far plane"
std::string lost_words(const PixelRecord& record, const TechniqueAtPixel& technique) {
    std::string lost;
    const auto add = [&](const std::string& what, Tally tally) {
        if (loss_words(tally).empty()) return;
        lost += fmt::format("{}{} {}", lost.empty() ? "" : ", ", what, loss_words(tally));
    };
    for (std::size_t i = 0; i < technique.tallies.size(); ++i)
        add(fmt::format("{:+} at {:.9g}", crossings_of(record, technique)[i].change,
                        crossings_of(record, technique)[i].depth),
            technique.tallies[i]);
    const std::int64_t open = technique.dark_cap_count;
    if (open != 0)
        add(fmt::format("{} dark {}", open, open == 1 ? "cap" : "caps"), technique.dark_caps);
    if (technique.counting.test == Counting::Test::depth_pass && record.ledger.counts.at_eye != 0)
        lost += fmt::format("{}{} around the eye", lost.empty() ? "" : ", ",
                            record.ledger.counts.at_eye);
    return lost;
}

bool meets_other_volumes(const PixelRecord& record, const TechniqueAtPixel& technique) {
    const auto same = [](const Crossing& a, const Crossing& b) {
        return a.depth == b.depth && a.change == b.change;
    };
    return technique.crossings &&
           !std::ranges::equal(*technique.crossings, record.ledger.crossings, same);
}

/// "zfail_reversed makes its volumes otherwise, and meets +1 at 3.2, -1 at 5"
std::string other_volumes_words(const TechniqueAtPixel& technique) {
    std::string words = "  " + technique.name + " makes its volumes otherwise, and meets";
    for (const Crossing& crossing : *technique.crossings)
        words += fmt::format("{} {:+} at {:.9g}", words.ends_with("meets") ? "" : ",",
                             crossing.change, crossing.depth);
    return words + (technique.crossings->empty() ? " none\n" : "\n");
}

std::string ray_text(const Scene& scene, const PixelRecord& record) {
    const glm::dvec3& eye = scene.camera.eye;
    std::string text = fmt::format("  ray       from {} along {}\n", vector_words(eye),
                                   vector_words(record.direction));
    const bool seen = record.seen != no_triangle;
    text += seen ? fmt::format("  sees      {} at {}, depth {:.9g}\n",
                               triangle_words(scene, record.seen),
                               vector_words(eye + record.ledger.surface * record.direction),
                               record.ledger.surface)
                 : "  sees      background\n";
    const Light& light = chosen_light(scene);
    const bool directional = light.kind == Light::Kind::directional;
    text += fmt::format("  light     {} {} {}\n", printable(light.name),
                        directional ? "shining along" : "at",
                        vector_words(directional ? light.direction : light.position));
    text +=
        fmt::format("  truth     {} ({})\n", name_of(record.visibility), name_of(record.exactness));
    if (record.occluder != no_triangle)
        text += fmt::format("  occluder  {}\n", triangle_words(scene, record.occluder));
    if (seen && !record.faces_light) text += "  the seen side faces away from the light\n";
    if (!record.in_cone) text += "  the seen point lies outside the spot light's cone\n";
    if (record.depth_margin)
        text += fmt::format("  margin    {:.9g} in depth to the nearest volume face\n",
                            *record.depth_margin);
    if (record.pixel_margin)
        text += fmt::format("  margin    {:.9g} pixels to the nearest of another class\n",
                            *record.pixel_margin);
    return text;
}

std::string ledger_text(const Scene& scene, const PixelRecord& record) {
    const RayCounts& counts = record.ledger.counts;
    std::string text = "  shadow volumes along the ray, by depth\n";
    text += fmt::format("    {:>14}  {:>6}  inside\n", "depth", "change");
    std::int32_t inside = counts.at_eye;
    text += fmt::format("    {:>14}  {:>6}  {:>6}\n", "eye", "", inside);
    for (const Crossing& crossing : record.ledger.crossings) {
        inside += crossing.change;
        text +=
            fmt::format("    {:>14.9g}  {:>+6}  {:>6}  {} of {}\n", crossing.depth, crossing.change,
                        inside, name_of(crossing.part), triangle_words(scene, crossing.triangle));
    }
    text += fmt::format("    {:>14}  {:>6}  {:>6}\n", "infinity", "", counts.at_infinity);
    if (!record.ledger.adds_up)
        text +=
            "    the depths are rounded, and rounding moved a crossing: the sums differ from the "
            "exact counts\n";
    text += fmt::format("  inside    {} at the eye, {} at near {:.9g}, ", counts.at_eye,
                        counts.at_near, scene.camera.near);
    if (record.seen != no_triangle) text += fmt::format("{} at the surface, ", counts.at_surface);
    return text + fmt::format("{} at far {:.9g}, {} at infinity\n", counts.at_far, record.far,
                              counts.at_infinity);
}

std::string techniques_text(const PixelRecord& record) {
    std::size_t width = std::string_view("technique").size();
    for (const TechniqueAtPixel& technique : record.techniques)
        width = std::max(width, technique.name.size());
    width += 2;
    std::string text = fmt::format("  {:<{}}{:>9}{:>8}{:>11}  {:<12}{:<15}{}\n", "technique", width,
                                   "predicted", "stored", "read back", "claim", "cause", "lost");
    for (const TechniqueAtPixel& technique : record.techniques) {
        std::string line =
            technique.error.empty()
                ? fmt::format("  {:<{}}{:>9}{:>8}{:>11}  {:<12}{:<15}{}", technique.name, width,
                              technique.predicted, technique.stored, technique.read_back,
                              name_of(technique.claim), cause_words(technique),
                              lost_words(record, technique))
                : fmt::format("  {:<{}}{}", technique.name, width, printable(technique.error));
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    for (const TechniqueAtPixel& technique : record.techniques)
        if (meets_other_volumes(record, technique)) text += other_volumes_words(technique);
    for (const TechniqueAtPixel& technique : record.techniques)
        if (technique.color) text += to_text(*technique.color, technique.name);
    return text;
}

std::string as_text(const Scene& scene, const PixelRecord& record) {
    std::string text = fmt::format("{} pixel ({},{}) of {}x{}\n", printable(scene.name), record.x,
                                   record.y, scene.camera.width, scene.camera.height);
    for (const std::string& note : scene.notes)
        text += fmt::format("  note      {}\n", printable(note));
    return text + ray_text(scene, record) + ledger_text(scene, record) + techniques_text(record);
}

/// The technique to draw: the first that differs, else the first that ran.
std::optional<std::size_t> technique_to_draw(const std::vector<TechniqueAtPixel>& techniques) {
    std::optional<std::size_t> first;
    for (std::size_t i = 0; i < techniques.size(); ++i) {
        if (!techniques[i].error.empty()) continue;
        if (techniques[i].cause != no_difference) return i;
        if (!first) first = i;
    }
    return first;
}

int explain(const ExplainOptions& options) {
    for (const std::string& file : {options.json, options.svg})
        if (!file.empty()) check_writable(file);
    check_apart(std::array{options.json, options.svg}, std::array{options.scene});
    const MemoryBudget& memory = options.picture.memory;
    require_picture(memory, options.picture.size.width, options.picture.size.height,
                    Workload::comparison);
    const Scene scene = load_scene(options.scene, options.picture.request());
    require_scene(memory, scene, Workload::comparison);
    Plan plan = make_plan(scene);
    plan.lighting = options.technique.lighting;
    const Tracer tracer(scene, options.picture.threads);
    const GroundTruth truth = trace(tracer);
    const ShadowDepths depths = count_shadow_depths(tracer, truth, finite_far(scene));
    PixelRecord record = record_pixel(tracer, truth, depths, options.pixel.x, options.pixel.y);
    const Silhouette silhouette(tracer);
    Gpu gpu(options.technique.platform);
    for (const Technique* technique : options.technique.chosen()) {
        if (options.technique.techniques.empty() && !suits(*technique, scene)) continue;
        record.techniques.push_back(
            ask(*technique, record, tracer, silhouette, truth, depths, plan, gpu));
    }
    const Scene told = in_file_units(scene);
    record = in_units(std::move(record), scene.unit);
    if (!options.quiet) print(as_text(told, record));
    for (const TechniqueAtPixel& technique : record.techniques)
        if (!technique.error.empty()) complain(technique.error);
    const std::string json =
        to_json(told, record).dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
    if (!options.json.empty()) write_file(options.json, json + "\n");
    const std::optional<std::size_t> drawn = technique_to_draw(record.techniques);
    if (!options.svg.empty() && drawn) write_file(options.svg, draw_cutaway(json, *drawn));
    const bool all_ran =
        std::all_of(record.techniques.begin(), record.techniques.end(),
                    [](const TechniqueAtPixel& technique) { return technique.error.empty(); });
    return all_ran ? exit_passed : exit_could_not;
}

/// The pixel must lie in the picture, whichever of the two flags stands first.
void check_inside(const ExplainOptions& options) {
    const PictureSize& size = options.picture.size;
    if (options.pixel.x < size.width && options.pixel.y < size.height) return;
    throw CLI::ValidationError(
        "--pixel", fmt::format("({},{}) lies outside the picture; it ends at ({},{})",
                               options.pixel.x, options.pixel.y, size.width - 1, size.height - 1));
}

} // namespace

Work add_explain(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "explain", "One pixel: its ray, surface, light, and what each technique counted there");
    const auto options = std::make_shared<ExplainOptions>();
    command->add_option("SCENE", options->scene, "A bundled name, or a path to .gltf, .glb or .md2")
        ->required()
        ->check(not_empty());
    command
        ->add_option_function<std::string>(
            "--pixel", [options](const std::string& text) { options->pixel = parse_pixel(text); },
            "Pixel, from the top left")
        ->type_name("X,Y")
        ->required();
    add_technique_flags(*command, options->technique);
    add_scene_flags(*command, options->picture);
    command->add_option("--json", options->json, "Also write it all here")
        ->type_name("FILE")
        ->check(not_empty());
    command
        ->add_option("--svg", options->svg,
                     "Draw the pixel here: the first technique that differs, or the one chosen")
        ->type_name("FILE")
        ->check(not_empty());
    command->add_flag("-q,--quiet", options->quiet, "No output but errors, and the files");
    command->final_callback([options] { check_inside(*options); });
    return [options] { return guarded([&] { return explain(*options); }); };
}

} // namespace shadowproof
