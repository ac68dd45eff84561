#include "compare/command/commands.h"
#include "compare/command/guard.h"
#include "compare/command/map_file.h"
#include "compare/command/output_files.h"
#include "compare/command/process/console.h"
#include "compare/command/process/exit_code.h"
#include "compare/output/write_file.h"
#include "scenes/error.h"
#include "scenes/load/picture/picture.h"
#include "scenes/surface/mipmap.h"
#include "scenes/surface/relief.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <memory>

namespace shadowproof {

namespace {

struct NormalMapOptions {
    std::string heights;
    std::string output;
    double scale = 1; ///< texels
    Wrap wrap = Wrap::repeat;
    int bits = 8;
    int level = 0;
    bool green_down = false;
    bool quiet = false;
    double timeout = 600; ///< seconds; 0: any number
    MemoryBudget memory{};
};

constexpr std::uint64_t most_pixels = std::uint64_t{1} << 26U;

/// Peak of the bytes per pixel: its height, slopes, normal, the map's texel, and that texel as
/// written, once more in the writer.
constexpr std::uint64_t bytes_made_of_pixel = sizeof(double) + sizeof(glm::dvec2) +
                                              sizeof(glm::dvec3) + sizeof(glm::dvec4) +
                                              2 * 4 * sizeof(float);

/// The first channel: gray or red.
Image<double> heights_of(const Picture& picture) {
    Image<double> heights(picture.width, picture.height);
    const auto channels = static_cast<std::size_t>(picture.channels);
    for (std::size_t i = 0; i < heights.pixels.size(); ++i)
        heights.pixels[i] = picture.values[i * channels];
    return heights;
}

int make_normal_map(const NormalMapOptions& options, int watcher) {
    Console console(options.quiet, watcher);
    check_writable(options.output);
    check_apart(std::array{options.output}, std::array{options.heights});
    const MemoryAccount memory(options.memory);
    console.progress(options.heights + ": reading");
    const Picture picture = read_picture(
        options.heights,
        {.memory = memory, .most_pixels = most_pixels, .bytes_made_of_pixel = bytes_made_of_pixel});
    const int levels = levels_of(picture.width, picture.height);
    if (options.level >= levels)
        throw Error(options.heights,
                    fmt::format("has {} levels, and {} is none of them", levels, options.level),
                    fmt::format("give --level 0 to {}", levels - 1));
    console.progress(options.heights + ": making its normals");
    Image<glm::dvec4> map = normal_map_of(
        slopes_of(heights_of(picture), options.wrap, options.wrap, options.scale), options.level);
    if (options.green_down)
        for (glm::dvec4& texel : map.pixels) texel.g = 1 - texel.g;
    console.progress("writing " + options.output);
    write_map(map, options.bits, options.output);
    console.line(fmt::format("{}: {}x{} normals of {}x{} heights of {} bits", options.output,
                             map.width, map.height, picture.width, picture.height, picture.bits));
    return exit_passed;
}

} // namespace

Work add_normal_map(CLI::App& app) {
    CLI::App* command = app.add_subcommand("normal-map", "A normal map from a height field");
    const auto options = std::make_shared<NormalMapOptions>();
    command
        ->add_option("HEIGHT", options->heights,
                     "A .png, .jpg or .exr of heights: its gray, or its red; 16 bits show no steps")
        ->required()
        ->check(not_empty());
    command
        ->add_option("-o,--output", options->output,
                     "The normal map: .png (8 or 16 bits a channel), or .exr (32-bit floats). RGB "
                     "is 0.5 + 0.5 n, y up the picture, as glTF has it; alpha the "
                     "denormalisation factor")
        ->type_name("FILE")
        ->required()
        ->check([](const std::string& file) {
            return is_map_file(file)
                       ? ""
                       : "'" + file + "' is neither; name a file that ends in .png or .exr";
        });
    add_memory_flag(*command, options->memory);
    command
        ->add_option_function<std::string>(
            "--scale",
            [options](const std::string& text) {
                const std::optional<double> scale = parse_number(text);
                if (!scale) throw CLI::ValidationError("--scale", "'" + text + "' is not a number");
                options->scale = *scale;
            },
            "How many texels high white is against black (1)")
        ->type_name("TEXELS");
    const std::map<std::string, Wrap> wraps{{"repeat", Wrap::repeat},
                                            {"mirror", Wrap::mirrored_repeat},
                                            {"clamp", Wrap::clamp_to_edge}};
    command->add_option("--wrap", options->wrap, "What lies past the border (repeat)")
        ->type_name("repeat|mirror|clamp")
        ->transform(CLI::CheckedTransformer(wraps).description(""));
    command->add_option("--bits", options->bits, "Bits a channel of a .png, 8 or 16 (8)")
        ->type_name("N")
        ->check(CLI::IsMember({8, 16}));
    command
        ->add_option("--level", options->level,
                     "Mipmap level (0): above 0, means of normals, whose lengths alpha holds")
        ->type_name("N")
        ->check(CLI::NonNegativeNumber);
    command->add_flag("--green-down", options->green_down,
                      "y down the picture, as some engines have it");
    add_timeout_flag(*command, options->timeout,
                     "Seconds above which it is given up (600; 0: any number)");
    command->add_flag("-q,--quiet", options->quiet, "No output but errors");
    return [options] {
        return guarded_within(options->timeout, options->heights,
                              [&](int watcher) { return make_normal_map(*options, watcher); });
    };
}

} // namespace shadowproof
