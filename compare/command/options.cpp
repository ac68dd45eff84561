#include "compare/command/options.h"

#include "compare/command/view_options.h"
#include "scenes/available_memory.h"
#include "scenes/load/common/nearest_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

namespace shadowproof {

namespace {

PictureSize parse_size(const std::string& text) {
    PictureSize size;
    const char* end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.width);
    const bool separated = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
    const auto height =
        separated ? std::from_chars(width.ptr + 1, end, size.height) : std::from_chars_result{};
    if (!separated || height.ec != std::errc() || height.ptr != end || size.width < 1 ||
        size.height < 1 || size.width > largest_side || size.height > largest_side)
        throw CLI::ValidationError("--size", fmt::format("'{}' is not a size; give WIDTHxHEIGHT "
                                                         "of 1 to {} pixels, as 512x512",
                                                         text, largest_side));
    return size;
}

std::string parameter_names() {
    std::string names;
    for (const StressParameter& parameter : stress_parameters())
        names += (names.empty() ? "" : ", ") + std::string(parameter.name);
    return names;
}

Stress parse_stress(const std::string& text) {
    const std::size_t sign = text.find('=');
    Stress stress{text.substr(0, sign), 0};
    if (find_parameter(stress.parameter) == nullptr)
        throw CLI::ValidationError("--stress",
                                   fmt::format("there is no parameter '{}'; there are {}",
                                               stress.parameter, parameter_names()));
    const std::optional<double> value =
        sign == std::string::npos ? std::nullopt : parse_number(text.substr(sign + 1));
    if (!value)
        throw CLI::ValidationError(
            "--stress", fmt::format("'{}' gives no number; give {}=VALUE", text, stress.parameter));
    stress.value = *value;
    return stress;
}

std::string technique_names() {
    std::string names;
    for (const Technique& technique : all_techniques())
        names += (names.empty() ? "" : ", ") + std::string(technique.name);
    return names;
}

const Technique* parse_technique(const std::string& name) {
    const Technique* technique = find_technique(name);
    std::vector<std::string> names;
    for (const Technique& each : all_techniques()) names.emplace_back(each.name);
    if (technique == nullptr)
        throw CLI::ValidationError("--technique",
                                   fmt::format("there is no technique '{}'{}; there are {}; and "
                                               "each of {}, joined by + with one of {}",
                                               name, did_you_mean(name, names), technique_names(),
                                               fmt::join(lighting_techniques(), ", "),
                                               fmt::join(shadowing_techniques(), ", ")));
    return technique;
}

GlPlatform parse_platform(const std::string& text) {
    if (text == "osmesa") return GlPlatform::osmesa;
    if (text == "egl") return GlPlatform::egl;
    throw CLI::ValidationError("--gl", "'" + text + "' is not known; give osmesa or egl");
}

template <class Values>
std::string names_of(const Values& values, std::string_view separator = ", ") {
    std::string names;
    for (const auto value : values)
        names += fmt::format("{}{}", names.empty() ? "" : separator, name_of(value));
    return names;
}

template <class Values>
auto parse_setting(const Values& values, const char* flag, const std::string& text) {
    const auto* const found = std::find_if(
        values.begin(), values.end(), [&](const auto value) { return name_of(value) == text; });
    if (found == values.end())
        throw CLI::ValidationError(
            flag, fmt::format("'{}' is not known; give one of {}", text, names_of(values)));
    return *found;
}

void add_lighting_flags(CLI::App& command, LightingSettings& settings) {
    command
        .add_option_function<std::string>(
            "--normalise",
            [&](const std::string& text) {
                settings.normalisation = parse_setting(all_normalisations, "--normalise", text);
            },
            "How the vectors of lighting are normalised (each technique's own)")
        ->type_name(names_of(all_normalisations, "|"));
    command
        .add_option("--cube-size", settings.cube_size,
                    fmt::format("Texels a side of the cube map's faces, with --normalise cube-map "
                                "or where that is the technique's own ({})",
                                usual_cube_size))
        ->type_name("N")
        ->check(CLI::Range(2, largest_cube_size));
    command
        .add_option("--newton-steps", settings.newton_steps,
                    fmt::format("Steps from the guess, with --normalise newton-raphson ({})",
                                usual_newton_steps))
        ->type_name("N")
        ->check(CLI::Range(0, most_newton_steps));
    command
        .add_option_function<std::string>(
            "--bumps",
            [&](const std::string& text) {
                settings.bump_form = parse_setting(all_bump_forms, "--bumps", text);
            },
            "In which form bump maps are kept (each technique's own)")
        ->type_name(names_of(all_bump_forms, "|"));
    command
        .add_option_function<std::string>(
            "--vectors",
            [&](const std::string& text) {
                settings.vectors = parse_setting(all_vector_origins, "--vectors", text);
            },
            "Where the vectors to light and eye are carried into tangent space (each technique's "
            "own)")
        ->type_name(names_of(all_vector_origins, "|"));
    command
        .add_option_function<std::string>(
            "--tangents",
            [&](const std::string& text) {
                settings.tangents = parse_setting(all_tangent_sources, "--tangents", text);
            },
            "Whose tangents lighting uses (vertices)")
        ->type_name(names_of(all_tangent_sources, "|"));
    command
        .add_option("--anisotropy", settings.anisotropy,
                    fmt::format("Lookups along a pixel's longer side, at most, of techniques that "
                                "filter bump maps ({})",
                                usual_anisotropy))
        ->type_name("N")
        ->check(CLI::Range(1, largest_anisotropy));
}

/// The least of numbers above zero.
constexpr double above_zero = std::numeric_limits<double>::denorm_min();

/// A length in the file's units, `least` or more.
void add_length_flag(CLI::App& command, const char* flag, std::optional<double>& value,
                     double least, const std::string& words) {
    command
        .add_option_function<std::string>(
            flag,
            [&value, flag, least](const std::string& text) {
                value = parse_number(text);
                if (!value || *value < least)
                    throw CLI::ValidationError(
                        flag, "'" + text + "' is no length here; give a number" +
                                  (least < 0 ? "" : (least > 0 ? " above 0" : ", 0 or more")) +
                                  ", as 0.15");
            },
            words)
        ->type_name("LENGTH");
}

void add_map_flags(CLI::App& command, MapSettings& settings) {
    command.add_option("--map-size", settings.size, "Texels a side of shadow maps (1024)")
        ->type_name("N")
        ->check(CLI::Range(1, 16384));
    add_length_flag(command, "--map-bias", settings.bias, std::numeric_limits<double>::lowest(),
                    "How much farther than its texel a point may be and still be lit (0.15)");
    const auto add_offset = [&](const char* flag, std::optional<double>& value, const char* words,
                                const char* unit) {
        command
            .add_option(flag, value,
                        std::string(words) +
                            " a surface is moved away in maps of depths; of cubes with --map-value "
                            "depth (0)")
            ->type_name(unit)
            ->check(CLI::Range(0.0, largest_polygon_offset));
    };
    add_offset("--map-slope-bias", settings.slope_bias,
               "How many times its depth's change over a texel's step", "FACTOR");
    add_offset("--map-offset-units", settings.offset_units,
               "How many times what its format resolves", "UNITS");
    const auto add_choice = [&](const char* flag, const auto& all, auto& value,
                                const std::string& words) {
        command
            .add_option_function<std::string>(
                flag,
                [&all, &value, flag](const std::string& text) {
                    value = parse_setting(all, flag, text);
                },
                words + " (each technique's own)")
            ->type_name(names_of(all, "|"));
    };
    add_choice("--map-value", all_map_values, settings.value,
               "What shadow maps hold; those of suns hold depths in any case");
    add_choice("--map-format", all_map_formats, settings.format, "How they store it");
    add_choice("--map-culling", all_map_cullings, settings.culling,
               "Which sides of casters they leave out");
    add_length_flag(command, "--map-near", settings.near, above_zero,
                    "Near plane of the light's camera (close to the light)");
    add_length_flag(
        command, "--map-far", settings.far, above_zero,
        "Far plane of the light's camera (the light's range, or just beyond the farthest "
        "caster)");
    command
        .add_option("--map-filter", settings.filter,
                    "Filtered maps: texels a side of the block that is averaged (4)")
        ->type_name("N")
        ->check(CLI::Range(1, largest_map_filter));
    add_choice("--map-average", all_map_averages, settings.average,
               "Filtered maps: what is averaged");
    add_choice("--map-edges", all_map_edges, settings.edges,
               "cube_map_pcf: what a block holds beyond a face");
}

void add_ray_flags(CLI::App& command, RaySettings& settings) {
    add_length_flag(command, "--ray-epsilon", settings.epsilon, 0,
                    fmt::format("traced_epsilon: hits of shadow rays nearer than this do not "
                                "count ({})",
                                customary_epsilon));
    add_length_flag(command, "--ray-offset", settings.offset, 0,
                    fmt::format("traced_offset: how far off the surface shadow rays start ({})",
                                customary_epsilon));
}

void add_volume_flags(CLI::App& command, VolumeSettings& settings) {
    add_length_flag(
        command, "--extrusion", settings.extrusion, 0,
        "zfail_truncated: how far volumes reach (half the diagonal of the scene's box)");
}

} // namespace

SceneRequest SceneOptions::request() const {
    return {.camera = camera,
            .light = light,
            .floor = floor.value_or(true),
            .time = time,
            .width = size.width,
            .height = size.height,
            .camera_aspect = !size_given,
            .view = view,
            .stress = stress,
            .memory = memory};
}

bool SceneOptions::is_default() const {
    const PictureSize ordinary;
    return !camera && !light && !is_given(view) && !stress && time == 0 &&
           size.width == ordinary.width && size.height == ordinary.height;
}

std::vector<const Technique*> TechniqueOptions::chosen() const {
    if (!techniques.empty()) return techniques;
    std::vector<const Technique*> all;
    for (const Technique& technique : all_techniques()) all.push_back(&technique);
    return all;
}

void add_scene_argument(CLI::App& command, std::string& scene) {
    command.add_option("SCENE", scene, "A bundled name, or a path to .gltf, .glb or .md2")
        ->required()
        ->check(not_empty());
}

void add_scenes_argument(CLI::App& command, std::vector<std::string>& scenes) {
    command
        .add_option("SCENE", scenes,
                    "Bundled names, or paths to .gltf, .glb or .md2 (all bundled scenes)")
        ->check(not_empty());
}

void add_scene_flags(CLI::App& command, SceneOptions& options) {
    command
        .add_option_function<std::string>(
            "--size",
            [&](const std::string& text) {
                options.size = parse_size(text);
                options.size_given = true;
            },
            "Picture size in pixels (512x512; where the camera has an aspect ratio, as wide as "
            "that "
            "at 512 high)")
        ->type_name("WxH");
    command.add_option("--camera", options.camera, "Camera, by name or index (the first)")
        ->type_name("CAMERA");
    command
        .add_option("--light", options.light,
                    "Light, by name or index (verify: each in turn, others: the first)")
        ->type_name("LIGHT");
    command
        .add_option("--floor", options.floor,
                    "A floor under a model without camera or light (yes; check: no)")
        ->type_name("yes|no");
    command
        .add_option_function<std::string>(
            "--time",
            [&](const std::string& text) {
                const std::optional<double> time = parse_number(text);
                if (!time)
                    throw CLI::ValidationError(
                        "--time", "'" + text + "' is not a time; give seconds, as 1.5");
                options.time = *time;
            },
            "Seconds at which animations are posed (0)")
        ->type_name("T");
    add_view_flags(command, options.view);
    command
        .add_option_function<std::string>(
            "--stress", [&](const std::string& text) { options.stress = parse_stress(text); },
            "Takes the scene to a parameter's value, as near_plane=1e-6: " + parameter_names())
        ->type_name("PARAMETER=VALUE");
    add_memory_flag(command, options.memory);
    command.add_option("--threads", options.threads, "Threads (0: one per core)")
        ->type_name("N")
        ->check(CLI::Range(0, 1024));
}

void add_memory_flag(CLI::App& command, MemoryBudget& budget) {
    budget = default_memory_budget();
    command
        .add_option_function<std::string>(
            "--memory",
            [&](const std::string& text) {
                const auto bytes = parse_bytes(text);
                if (!bytes)
                    throw CLI::ValidationError(
                        "--memory", "'" + text + "' is no size; give bytes, as 2GB or 1.5GiB");
                budget = {*bytes, "--memory"};
            },
            "Bytes that may be taken in all, as 2GB (three quarters of what is available)")
        ->type_name("SIZE");
}

void add_timeout_flag(CLI::App& command, double& seconds, const std::string& words) {
    command.add_option("--timeout", seconds, words)
        ->type_name("SECONDS")
        ->check([](const std::string& text) {
            // A range check lets NaN through: all comparisons with it are false.
            return text.find_first_of("nN") == std::string::npos ? std::string()
                                                                 : text + " is not a number";
        })
        ->check(CLI::Range(0.0, 1e9).description(""));
}

std::optional<double> parse_number(const std::string& text) {
    const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
    const char* const end = text.data() + text.size();
    double value = 0;
    const auto parsed = std::from_chars(first, end, value);
    if (parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(value)) return std::nullopt;
    return value;
}

void add_technique_flags(CLI::App& command, TechniqueOptions& options) {
    command
        .add_option_function<std::vector<std::string>>(
            "--technique",
            [&](const std::vector<std::string>& names) {
                options.techniques.clear();
                for (const std::string& name : names) {
                    const Technique* technique = parse_technique(name);
                    auto& chosen = options.techniques;
                    if (std::find(chosen.begin(), chosen.end(), technique) == chosen.end())
                        chosen.push_back(technique);
                }
            },
            "Techniques, separated by commas (all)")
        ->delimiter(',')
        ->allow_extra_args(false) // a scene may follow
        ->type_name("TECHNIQUE");
    command
        .add_option_function<std::string>(
            "--gl", [&](const std::string& text) { options.platform = parse_platform(text); },
            "Where OpenGL comes from (osmesa)")
        ->type_name("osmesa|egl");
    add_lighting_flags(command, options.asked.lighting);
    add_volume_flags(command, options.asked.volumes);
    add_map_flags(command, options.asked.map);
    add_ray_flags(command, options.asked.rays);
}

CLI::Validator not_empty() {
    return {[](const std::string& text) { return text.empty() ? "the path is empty" : ""; }, "",
            "not empty"};
}

namespace {

/// A flag and its value for each setting that was asked for.
std::vector<std::string> settings(const TechniqueSettings& asked) {
    std::vector<std::string> words;
    const auto add = [&](const char* flag, const std::string& value) {
        words.emplace_back(flag);
        words.push_back(value);
    };
    const LightingSettings& lighting = asked.lighting;
    if (lighting.normalisation) add("--normalise", std::string(name_of(*lighting.normalisation)));
    if (lighting.cube_size) add("--cube-size", fmt::format("{}", *lighting.cube_size));
    if (lighting.newton_steps) add("--newton-steps", fmt::format("{}", *lighting.newton_steps));
    if (lighting.bump_form) add("--bumps", std::string(name_of(*lighting.bump_form)));
    if (lighting.vectors) add("--vectors", std::string(name_of(*lighting.vectors)));
    if (lighting.tangents) add("--tangents", std::string(name_of(*lighting.tangents)));
    if (lighting.anisotropy) add("--anisotropy", fmt::format("{}", *lighting.anisotropy));
    if (const std::optional<double>& extrusion = asked.volumes.extrusion)
        add("--extrusion", fmt::format("{}", *extrusion));
    const MapSettings& map = asked.map;
    if (map.size) add("--map-size", fmt::format("{}", *map.size));
    if (map.bias) add("--map-bias", fmt::format("{}", *map.bias));
    if (map.slope_bias) add("--map-slope-bias", fmt::format("{}", *map.slope_bias));
    if (map.offset_units) add("--map-offset-units", fmt::format("{}", *map.offset_units));
    if (map.value) add("--map-value", std::string(name_of(*map.value)));
    if (map.format) add("--map-format", std::string(name_of(*map.format)));
    if (map.culling) add("--map-culling", std::string(name_of(*map.culling)));
    if (map.near) add("--map-near", fmt::format("{}", *map.near));
    if (map.far) add("--map-far", fmt::format("{}", *map.far));
    if (map.filter) add("--map-filter", fmt::format("{}", *map.filter));
    if (map.average) add("--map-average", std::string(name_of(*map.average)));
    if (map.edges) add("--map-edges", std::string(name_of(*map.edges)));
    const RaySettings& rays = asked.rays;
    if (rays.epsilon) add("--ray-epsilon", fmt::format("{}", *rays.epsilon));
    if (rays.offset) add("--ray-offset", fmt::format("{}", *rays.offset));
    return words;
}

} // namespace

std::vector<std::string> settings(const SceneOptions& scene, const TechniqueOptions& technique) {
    std::vector<std::string> words;
    const auto add = [&](const char* flag, const std::string& value) {
        words.emplace_back(flag);
        words.push_back(value);
    };
    const PictureSize ordinary;
    if (scene.size_given || scene.size.width != ordinary.width ||
        scene.size.height != ordinary.height)
        add("--size", fmt::format("{}x{}", scene.size.width, scene.size.height));
    if (scene.camera) add("--camera", *scene.camera);
    if (scene.light) add("--light", *scene.light);
    if (scene.floor) add("--floor", *scene.floor ? "yes" : "no");
    if (scene.time != 0) add("--time", fmt::format("{}", scene.time));
    for (const std::string& word : settings(scene.view)) words.push_back(word);
    if (scene.stress) add("--stress", words_of(*scene.stress));
    if (technique.platform == GlPlatform::egl) add("--gl", "egl");
    for (const std::string& word : settings(technique.asked)) words.push_back(word);
    return words;
}

std::string unheeded_settings(const TechniqueOptions& options) {
    const std::vector<const Technique*> chosen = options.chosen();
    const std::vector<std::string> words = settings(options.asked);
    std::string unheeded;
    for (std::size_t i = 0; i < words.size(); i += 2) {
        const std::string_view name = std::string_view(words[i]).substr(2);
        if (std::ranges::any_of(chosen, [&](const Technique* each) { return heeds(*each, name); }))
            continue;
        unheeded += (unheeded.empty() ? "" : ", ") + words[i];
    }
    if (unheeded.empty()) return {};
    return fmt::format("{}: of no effect on the techniques that are tried (shadowproof list "
                       "names what each heeds)",
                       unheeded);
}

std::string extension_of(const std::string& file) {
    std::string extension = std::filesystem::path(file).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

} // namespace shadowproof
