#include "compare/blank.h"
#include "compare/classify.h"
#include "compare/command/commands.h"
#include "compare/command/drawing.h"
#include "compare/command/guard.h"
#include "compare/command/output_files.h"
#include "compare/command/process/console.h"
#include "compare/command/process/exit_code.h"
#include "compare/command/process/standard_output.h"
#include "compare/command/scene_result.h"
#include "compare/families.h"
#include "compare/memory.h"
#include "compare/output/write_file.h"
#include "compare/report/color_words.h"
#include "compare/report/escape.h"
#include "compare/report/pixel_json.h"
#include "raster/render.h"
#include "reference/predict/ledger.h"
#include "scenes/error.h"
#include "scenes/load/admission.h"
#include "scenes/load/catalog.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
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
    double timeout = 600; ///< seconds; 0: any number
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

TechniqueAtPixel ask(const Technique& technique, const PixelRecord& record,
                     const TracedScene& traced, const Plan& plan, Gpu& gpu) {
    TechniqueAtPixel at;
    at.name = technique.name;
    try {
        const Frame frame = render(technique, traced.scene(), plan, gpu);
        const std::unique_ptr<Judge> judge = judge_of(traced, frame);
        const int x = record.x;
        const int y = record.y;
        const PixelFinding found = classify_pixel(traced, frame, *judge, x, y);
        refuse_blank(technique.name, traced.truth(), frame,
                     found.cause == static_cast<std::uint8_t>(Cause::unexplained));
        at.family = frame.family;
        at.claim = frame.claim.at(x, y);
        at.share = lit_share(frame, frame.claim.index(x, y));
        at.shows_surface = frame.shows_surface();
        if (at.shows_surface) at.shown = frame.triangle.at(x, y);
        at.cause = found.cause;
        at.too_near = found.too_near;
        for (const CauseWords& words : all_causes)
            if (found.also.contains(words.cause)) at.also.push_back(words.cause);
        at.account = judge->account(record, traced.scene().unit);
        if (!frame.color.pixels.empty())
            at.color = account_for_color(traced.tracer(), traced.truth(), frame, x, y,
                                         traced.lights_before());
    } catch (const std::bad_alloc&) {
        at.error = at.name + ": " + out_of_memory;
    } catch (const std::runtime_error& error) {
        at.error = error.what();
    }
    return at;
}

/// "lit", "partly_lit 0.6875"
std::string claim_words(const TechniqueAtPixel& technique) {
    if (technique.claim != Visibility::partly_lit) return std::string(name_of(technique.claim));
    return fmt::format("{} {:.4g}", name_of(technique.claim), technique.share);
}

/// "near_plane", "near_plane with counter", "precision where its numbers suffice"
std::string cause_words(const TechniqueAtPixel& technique) {
    if (technique.cause == no_difference) return "no difference";
    std::string words(all_causes[technique.cause].name);
    for (std::size_t i = 0; i < technique.also.size(); ++i)
        words +=
            fmt::format("{} {}", i == 0 ? " with" : ",", shadowproof::name_of(technique.also[i]));
    return technique.too_near ? words + " where its numbers suffice" : words;
}

std::string ray_text(const Scene& scene, const PixelRecord& record) {
    std::string text = fmt::format("  ray       from {} along {}\n", vector_words(record.start),
                                   vector_words(record.direction));
    const bool seen = record.seen != no_triangle;
    text += seen ? fmt::format(
                       "  sees      {} at {}, depth {:.9g}\n", triangle_words(scene, record.seen),
                       vector_words(record.start + record.depth * record.direction), record.depth)
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

/// What alpha masks take from the shadow depth at the surface; empty where that is nothing.
std::string masks_text(const PixelRecord& record) {
    if (record.let_through == 0) return {};
    return fmt::format("  masks     the light falls through holes in the casters of {} of those at "
                       "the surface\n",
                       record.let_through);
}

/// The techniques of one family as a table: what their evidence is, their claims and causes.
class FamilyTable {
public:
    explicit FamilyTable(const std::vector<const TechniqueAtPixel*>& rows) : rows_(rows) {
        add("technique", Side::left, [](const auto& row) { return row.name; });
        const Account& account = rows.front()->account;
        for (std::size_t i = 0; i < account.columns.size(); ++i)
            add(account.columns[i].title, Side::right,
                [i](const auto& row) { return row.account.columns[i].text; });
        add("claim", Side::left, claim_words);
        add("cause", Side::left, cause_words);
        if (!account.remark.title.empty())
            add(account.remark.title, Side::left,
                [](const auto& row) { return row.account.remark.text; });
    }

    std::string text() const {
        std::string text;
        for (std::size_t row = 0; row <= rows_.size(); ++row) {
            std::string line = " ";
            for (const Column& column : columns_)
                line += column.side == Side::left
                            ? fmt::format(" {:<{}} ", column.cells[row], column.width)
                            : fmt::format(" {:>{}} ", column.cells[row], column.width);
            text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
        }
        return text;
    }

private:
    enum class Side : std::uint8_t { left, right };
    struct Column {
        Side side = Side::left;
        std::size_t width = 0;
        std::vector<std::string> cells; ///< its title, and one per row
    };
    std::vector<const TechniqueAtPixel*> rows_;
    std::vector<Column> columns_;

    void add(const std::string& title, Side side,
             const std::function<std::string(const TechniqueAtPixel&)>& cell) {
        Column column{side, 0, {title}};
        for (const TechniqueAtPixel* row : rows_) column.cells.push_back(cell(*row));
        for (const std::string& text : column.cells)
            column.width = std::max(column.width, text.size());
        columns_.push_back(std::move(column));
    }
};

std::string techniques_text(const std::vector<TechniqueAtPixel>& techniques) {
    std::string text;
    for (const Family& family : all_families()) {
        std::vector<const TechniqueAtPixel*> rows;
        for (const TechniqueAtPixel& technique : techniques)
            if (technique.error.empty() && technique.family == family.name)
                rows.push_back(&technique);
        if (!rows.empty()) text += FamilyTable(rows).text();
    }
    for (const TechniqueAtPixel& technique : techniques) {
        if (!technique.error.empty())
            text += fmt::format("  {}  {}\n", technique.name, printable(technique.error));
        if (!technique.account.note.empty())
            text += fmt::format("  {} {}\n", technique.name, technique.account.note);
    }
    for (const TechniqueAtPixel& technique : techniques)
        if (technique.color) text += to_text(*technique.color, technique.name);
    return text;
}

std::string as_text(const Scene& scene, const PixelRecord& record,
                    const std::vector<TechniqueAtPixel>& techniques) {
    std::string text = fmt::format("{} pixel ({},{}) of {}x{}\n", printable(scene.name), record.x,
                                   record.y, scene.camera.width, scene.camera.height);
    for (const std::string& note : scene.notes)
        text += fmt::format("  note      {}\n", printable(note));
    if (const auto note = note_on_added_lights(scene))
        text += fmt::format("  note      {}\n", printable(*note));
    return text + ray_text(scene, record) + ledger_text(scene, record) + masks_text(record) +
           techniques_text(techniques);
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

std::string outside(const PixelPosition& pixel, int width, int height) {
    return fmt::format("({},{}) lies outside the picture; it ends at ({},{})", pixel.x, pixel.y,
                       width - 1, height - 1);
}

int explain(const ExplainOptions& options, int watcher) {
    Console console(options.quiet, watcher);
    for (const std::string& file : {options.json, options.svg})
        if (!file.empty()) check_writable(file);
    check_apart(std::array{options.json, options.svg}, std::array{options.scene});
    const MemoryBudget& memory = options.picture.memory;
    require_picture(memory, options.picture.size.width, options.picture.size.height,
                    Workload::comparison);
    console.progress(options.scene + ": reading");
    const Scene scene = load_scene(options.scene, options.picture.request());
    if (options.pixel.x >= scene.camera.width || options.pixel.y >= scene.camera.height)
        throw Error("--pixel", outside(options.pixel, scene.camera.width, scene.camera.height),
                    "name a pixel within it");
    require_scene(memory, scene, Workload::comparison);
    require_memory(memory, options.technique.asked);
    Plan plan = make_plan(scene);
    plan.asked = options.technique.asked;
    console.progress(options.scene + ": tracing");
    const Tracer tracer(scene, options.picture.threads);
    const GroundTruth truth = trace(tracer);
    const TracedScene traced(tracer, truth);
    const PixelRecord record = record_pixel(traced, options.pixel.x, options.pixel.y);
    Gpu gpu(options.technique.platform);
    std::vector<TechniqueAtPixel> techniques;
    for (const Technique* technique : options.technique.chosen()) {
        if (options.technique.techniques.empty() && !suits(*technique, scene)) continue;
        console.progress(fmt::format("{}: {}", options.scene, technique->name));
        techniques.push_back(ask(*technique, record, traced, plan, gpu));
    }
    console.clear_progress();
    const Scene told = in_file_units(scene);
    const PixelRecord told_record = in_units(record, scene.unit);
    if (!options.quiet) print(as_text(told, told_record, techniques));
    for (const TechniqueAtPixel& technique : techniques)
        if (!technique.error.empty()) complain(technique.error);
    const std::string json = to_json(told, told_record, techniques)
                                 .dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
    if (!options.json.empty()) write_file(options.json, json + "\n");
    const std::optional<std::size_t> drawn = technique_to_draw(techniques);
    if (!options.svg.empty() && drawn) write_file(options.svg, draw_cutaway(json, *drawn));
    const bool all_ran =
        std::all_of(techniques.begin(), techniques.end(),
                    [](const TechniqueAtPixel& technique) { return technique.error.empty(); });
    return all_ran ? exit_passed : exit_could_not;
}

/// The pixel must lie in the picture, whichever of the two flags stands first. Scenes under stress,
/// and files whose camera has an aspect ratio, have pictures of another shape.
void check_inside(const ExplainOptions& options) {
    const PictureSize& size = options.picture.size;
    const bool has_that_size = options.picture.size_given || is_bundled(options.scene);
    if (options.picture.stress || !has_that_size ||
        (options.pixel.x < size.width && options.pixel.y < size.height))
        return;
    throw CLI::ValidationError("--pixel", outside(options.pixel, size.width, size.height));
}

} // namespace

Work add_explain(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "explain", "One pixel: its ray, surface, light, and what each technique counted there");
    const auto options = std::make_shared<ExplainOptions>();
    add_scene_argument(*command, options->scene);
    command
        ->add_option_function<std::string>(
            "--pixel", [options](const std::string& text) { options->pixel = parse_pixel(text); },
            "Pixel, from the top left")
        ->type_name("X,Y")
        ->required();
    add_technique_flags(*command, options->technique);
    add_scene_flags(*command, options->picture);
    add_timeout_flag(*command, options->timeout,
                     "Seconds above which it is given up (600; 0: any number)");
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
    return [options] {
        return guarded_within(options->timeout, options->scene,
                              [&](int watcher) { return explain(*options, watcher); });
    };
}

} // namespace shadowproof
