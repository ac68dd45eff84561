#include "compare/command/view_options.h"

#include "compare/command/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <span>

namespace shadowproof {

namespace {

/// As many finite numbers as are wanted; nothing where there are more, fewer or others.
std::optional<std::vector<double>> parse_numbers(const std::string& text, std::size_t wanted) {
    constexpr const char* separators = ", \t\n";
    std::vector<double> numbers;
    for (std::size_t at = 0; (at = text.find_first_not_of(separators, at)) != std::string::npos;) {
        const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
        const std::optional<double> number = parse_number(text.substr(at, end - at));
        if (!number) return std::nullopt;
        numbers.push_back(*number);
        at = end;
    }
    return numbers.size() == wanted ? std::optional(numbers) : std::nullopt;
}

std::vector<double> require_numbers(const char* flag, const std::string& text, std::size_t wanted,
                                    const char* example) {
    const auto numbers = parse_numbers(text, wanted);
    if (!numbers)
        throw CLI::ValidationError(
            flag, fmt::format("'{}' is not {} numbers; give them as {}", text, wanted, example));
    return *numbers;
}

std::string joined(std::span<const double> numbers) {
    return fmt::format("{}", fmt::join(numbers, ","));
}

} // namespace

void add_view_flags(CLI::App& command, ViewOverride& view) {
    command
        .add_option_function<std::string>(
            "--camera-matrix",
            [&view](const std::string& text) {
                const auto numbers = require_numbers("--camera-matrix", text, 16,
                                                     "1,0,0,0, 0,1,0,0, 0,0,1,0, X,Y,Z,1");
                std::copy(numbers.begin(), numbers.end(), view.camera_matrix.emplace().begin());
            },
            "World matrix of the camera in place of the file's: 16 numbers, column by column as "
            "glTF has it, looking down -z with y up")
        ->type_name("M0,...,M15");
    command
        .add_option_function<std::string>(
            "--light-position",
            [&view](const std::string& text) {
                const auto numbers = require_numbers("--light-position", text, 3, "1,2.5,-3");
                view.light_position = {numbers[0], numbers[1], numbers[2]};
            },
            "Where the light stands, in place of the file's position")
        ->type_name("X,Y,Z");
    command
        .add_option_function<std::string>(
            "--fov",
            [&view](const std::string& text) {
                const std::optional<double> degrees = parse_number(text);
                if (!degrees || !(*degrees > 0 && *degrees < 180))
                    throw CLI::ValidationError(
                        "--fov",
                        "'" + text + "' is no angle between 0 and 180 degrees; give one, as 45");
                view.vertical_field_of_view = *degrees / 180 * std::numbers::pi;
            },
            "Vertical field of view in degrees, in place of the file's")
        ->type_name("DEGREES");
    command
        .add_option_function<std::string>(
            "--ortho",
            [&view](const std::string& text) {
                const std::optional<double> height = parse_number(text);
                if (!height || !(*height > 0))
                    throw CLI::ValidationError(
                        "--ortho", "'" + text + "' is no length above 0; give one, as 10");
                view.orthographic_height = *height;
            },
            "An orthographic camera in place of the file's, whose picture is so high in the file's "
            "units")
        ->type_name("HEIGHT")
        ->excludes("--fov");
}

bool is_given(const ViewOverride& view) {
    return view.camera_matrix || view.light_position || view.vertical_field_of_view ||
           view.orthographic_height;
}

std::vector<std::string> settings(const ViewOverride& view) {
    std::vector<std::string> words;
    const auto add = [&](const char* flag, const std::string& value) {
        words.emplace_back(flag);
        words.push_back(value);
    };
    if (view.camera_matrix) add("--camera-matrix", joined(*view.camera_matrix));
    if (view.light_position) {
        const glm::dvec3& at = *view.light_position;
        add("--light-position", joined(std::array{at.x, at.y, at.z}));
    }
    if (view.vertical_field_of_view)
        add("--fov", fmt::format("{}", *view.vertical_field_of_view / std::numbers::pi * 180));
    if (view.orthographic_height) add("--ortho", fmt::format("{}", *view.orthographic_height));
    return words;
}

} // namespace shadowproof
