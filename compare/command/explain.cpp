#include "compare/command/commands.h"
#include "raster/render.h"
#include "reference/ledger.h"
#include "scenes/catalog.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

namespace shadowproof {

namespace {

using Json = nlohmann::ordered_json;

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
};

/// What one technique says of the pixel.
struct TechniqueWords {
    std::string name;
    std::string error;
    std::int64_t predicted = 0; ///< before wrapping
    int stored = 0;             ///< as the stencil buffer ought to hold it
    int read_back = 0;
    Visibility claim = Visibility::background;
    std::uint8_t cause = no_difference;
};

struct Explanation {
    const Scene& scene;
    PixelPosition pixel;
    glm::dvec3 direction;
    RayTruth truth;
    bool faces_light = false; ///< the seen side is the light's
    RayLedger ledger;
    std::int32_t at_near = 0;
    std::int32_t at_surface = 0;
    std::int32_t at_far = 0;
    double far = 0;
    std::vector<TechniqueWords> techniques;
};

std::string_view name_of(Visibility visibility) {
    switch (visibility) {
    case Visibility::lit:
        return "lit";
    case Visibility::shadowed:
        return "shadowed";
    case Visibility::background:
        break;
    }
    return "background";
}

std::string_view name_of(Exactness exactness) {
    switch (exactness) {
    case Exactness::filtered:
        return "filtered";
    case Exactness::exact:
        return "exact";
    case Exactness::degenerate:
        break;
    }
    return "degenerate";
}

std::string_view name_of(Crossing::Part part) {
    return part == Crossing::Part::light_cap ? "light cap" : "side";
}

const std::string& mesh_name(const Scene& scene, std::uint32_t triangle) {
    return scene.meshes[mesh_of(scene, triangle)].name;
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

TechniqueWords ask(const Technique& technique, const Tracer& tracer, const GroundTruth& truth,
                   const ShadowDepths& depths, const Plan& plan, PixelPosition at, Gpu& gpu) {
    TechniqueWords words;
    words.name = technique.name;
    try {
        const Frame frame = render(technique, tracer.scene(), plan, gpu);
        const Comparison comparison = classify(tracer, truth, depths, frame);
        words.predicted =
            predicted_count(depths, truth, at.x, at.y, frame.counting, frame.depth_model);
        words.stored = comparison.predicted.at(at.x, at.y);
        words.read_back = frame.stencil.at(at.x, at.y);
        words.claim = frame.claim.at(at.x, at.y);
        words.cause = comparison.cause.at(at.x, at.y);
    } catch (const std::runtime_error& error) {
        words.error = error.what();
    }
    return words;
}

std::string cause_words(const TechniqueWords& technique) {
    return technique.cause == no_difference ? "no difference"
                                            : std::string(all_causes[technique.cause].name);
}

std::string as_text(const Explanation& e) {
    const Scene& scene = e.scene;
    std::string text = fmt::format("{} pixel ({},{}) of {}x{}\n", scene.name, e.pixel.x, e.pixel.y,
                                   scene.camera.width, scene.camera.height);
    for (const std::string& note : scene.notes) text += fmt::format("  note      {}\n", note);
    text += fmt::format("  ray       from {} along {}\n", vector_words(scene.camera.eye),
                        vector_words(e.direction));
    const bool seen = e.truth.triangle != no_triangle;
    text += seen ? fmt::format("  sees      {} at {}, depth {:.9g}\n",
                               triangle_words(scene, e.truth.triangle),
                               vector_words(scene.camera.eye + e.truth.depth * e.direction),
                               e.truth.depth)
                 : "  sees      background\n";
    const Light& light = chosen_light(scene);
    text += fmt::format("  light     {} at {}\n", light.name, vector_words(light.position));
    text += fmt::format("  truth     {} ({})\n", name_of(e.truth.visibility),
                        name_of(e.truth.exactness));
    if (e.truth.occluder != no_triangle)
        text += fmt::format("  occluder  {}\n", triangle_words(scene, e.truth.occluder));
    if (seen && !e.faces_light) text += "  the seen side faces away from the light\n";

    text += "  shadow volumes along the ray, by depth\n";
    text += fmt::format("    {:>14}  {:>6}  inside\n", "depth", "change");
    std::int32_t inside = e.ledger.at_eye;
    text += fmt::format("    {:>14}  {:>6}  {:>6}\n", "eye", "", inside);
    for (const Crossing& crossing : e.ledger.crossings) {
        inside += crossing.change;
        text += fmt::format("    {:>14.9g}  {:>+6}  {:>6}  {}{}\n", crossing.depth, crossing.change,
                            inside, name_of(crossing.part),
                            crossing.triangle == no_triangle
                                ? ""
                                : " of " + triangle_words(scene, crossing.triangle));
    }
    text += fmt::format("    {:>14}  {:>6}  {:>6}\n", "infinity", "", e.ledger.at_infinity);
    text += fmt::format("  inside    {} at the eye, {} at near {:.9g}, ", e.ledger.at_eye,
                        e.at_near, scene.camera.near);
    if (seen) text += fmt::format("{} at the surface, ", e.at_surface);
    text +=
        fmt::format("{} at far {:.9g}, {} at infinity\n", e.at_far, e.far, e.ledger.at_infinity);

    text += fmt::format("  {:<16}{:>9}{:>8}{:>11}  {:<12}{}\n", "technique", "predicted", "stored",
                        "read back", "claim", "cause");
    for (const TechniqueWords& technique : e.techniques)
        text += technique.error.empty()
                    ? fmt::format("  {:<16}{:>9}{:>8}{:>11}  {:<12}{}\n", technique.name,
                                  technique.predicted, technique.stored, technique.read_back,
                                  name_of(technique.claim), cause_words(technique))
                    : fmt::format("  {:<16}{}\n", technique.name, technique.error);
    return text;
}

Json vector_json(const glm::dvec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json triangle_json(const Scene& scene, std::uint32_t triangle) {
    if (triangle == no_triangle) return nullptr;
    return {{"triangle", triangle}, {"mesh", mesh_name(scene, triangle)}};
}

Json technique_json(const TechniqueWords& technique) {
    if (!technique.error.empty()) return {{"name", technique.name}, {"error", technique.error}};
    return {{"name", technique.name},
            {"predicted", technique.predicted},
            {"stored", technique.stored},
            {"read_back", technique.read_back},
            {"claim", name_of(technique.claim)},
            {"cause", technique.cause == no_difference ? Json(nullptr)
                                                       : Json(all_causes[technique.cause].name)}};
}

Json as_json(const Explanation& e) {
    const Scene& scene = e.scene;
    const Light& light = chosen_light(scene);
    const bool seen = e.truth.triangle != no_triangle;
    Json json{{"schema", "shadowproof/pixel/1"},
              {"scene", scene.name},
              {"x", e.pixel.x},
              {"y", e.pixel.y},
              {"width", scene.camera.width},
              {"height", scene.camera.height},
              {"eye", vector_json(scene.camera.eye)},
              {"direction", vector_json(e.direction)},
              {"near", scene.camera.near},
              {"far", e.far},
              {"light", {{"name", light.name}, {"position", vector_json(light.position)}}},
              {"truth", name_of(e.truth.visibility)},
              {"exactness", name_of(e.truth.exactness)},
              {"seen", triangle_json(scene, e.truth.triangle)},
              {"occluder", triangle_json(scene, e.truth.occluder)},
              {"crossings", Json::array()},
              {"inside",
               {{"eye", e.ledger.at_eye},
                {"near", e.at_near},
                {"surface", seen ? Json(e.at_surface) : Json(nullptr)},
                {"far", e.at_far},
                {"infinity", e.ledger.at_infinity}}},
              {"notes", scene.notes},
              {"techniques", Json::array()}};
    if (seen) {
        json["seen"]["depth"] = e.truth.depth;
        json["seen"]["point"] = vector_json(scene.camera.eye + e.truth.depth * e.direction);
        json["seen"]["faces_light"] = e.faces_light;
    }
    for (const Crossing& crossing : e.ledger.crossings)
        json["crossings"].push_back({{"depth", crossing.depth},
                                     {"change", crossing.change},
                                     {"kind", name_of(crossing.part)},
                                     {"caster", triangle_json(scene, crossing.triangle)}});
    for (const TechniqueWords& technique : e.techniques)
        json["techniques"].push_back(technique_json(technique));
    return json;
}

int explain(const ExplainOptions& options) {
    const Scene scene = load_scene(options.scene, options.picture.request());
    const Plan plan = make_plan(scene);
    const Tracer tracer(scene, options.picture.threads);
    const GroundTruth truth = trace(tracer);
    const ShadowDepths depths = count_shadow_depths(tracer, truth, finite_far(scene));
    const auto [x, y] = options.pixel;
    const glm::dvec3 direction = ray_direction(scene.camera, x + 0.5, y + 0.5);
    Explanation e{.scene = scene,
                  .pixel = options.pixel,
                  .direction = direction,
                  .truth = trace_ray(tracer, direction),
                  .faces_light = false,
                  .ledger = ray_ledger(tracer, direction),
                  .at_near = depths.at_near.at(x, y),
                  .at_surface = depths.at_surface.at(x, y),
                  .at_far = depths.at_far.at(x, y),
                  .far = depths.far,
                  .techniques = {}};
    if (e.truth.triangle != no_triangle)
        e.faces_light = sides_of(tracer, e.truth.triangle).faces_light();
    Gpu gpu(options.technique.platform);
    for (const Technique* technique : options.technique.chosen())
        e.techniques.push_back(ask(*technique, tracer, truth, depths, plan, options.pixel, gpu));
    fmt::print("{}", as_text(e));
    if (!options.json.empty())
        write_file(options.json,
                   as_json(e).dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
    const bool all_ran = std::all_of(e.techniques.begin(), e.techniques.end(),
                                     [](const TechniqueWords& t) { return t.error.empty(); });
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
    command->add_option("SCENE", options->scene, "A bundled name, or a path to .gltf or .glb")
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
    command->final_callback([options] { check_inside(*options); });
    return [options] { return explain(*options); };
}

} // namespace shadowproof
