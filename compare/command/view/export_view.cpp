#include "compare/command/commands.h"
#include "compare/command/guard.h"
#include "compare/command/output_files.h"
#include "compare/command/process/exit_code.h"
#include "compare/command/process/standard_output.h"
#include "compare/command/view/view_json.h"
#include "compare/output/write_file.h"
#include "scenes/load/admission.h"
#include "scenes/load/catalog.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>

namespace shadowproof {

namespace {

struct ExportOptions {
    std::string scene;
    SceneOptions picture;
    std::vector<const Convention*> engines; ///< empty: all
    std::string output;                     ///< empty: the console
    double timeout = 600;                   ///< seconds; 0: any number
};

int export_view(const ExportOptions& options) {
    if (!options.output.empty()) {
        check_writable(options.output);
        check_apart(std::array{options.output}, std::array{options.scene});
    }
    const Scene scene = in_file_units(load_scene(options.scene, options.picture.request()));
    const std::string text = view_json(scene, options.picture.time, options.engines)
                                 .dump(1, ' ', false, nlohmann::json::error_handler_t::replace) +
                             "\n";
    if (options.output.empty())
        print(text);
    else
        write_file(options.output, text);
    return exit_passed;
}

std::string engine_names() {
    std::string names;
    for (const Convention& convention : conventions())
        names += (names.empty() ? "" : ", ") + std::string(convention.name);
    return names;
}

const Convention* parse_engine(const std::string& name) {
    const auto& all = conventions();
    const auto* const found =
        std::find_if(all.begin(), all.end(),
                     [&](const Convention& convention) { return convention.name == name; });
    if (found == all.end())
        throw CLI::ValidationError(
            "--engine", fmt::format("'{}' is not known; there are {}", name, engine_names()));
    return found;
}

} // namespace

Work add_export_view(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "export-view", "A scene's camera and light in other engines' conventions, as JSON");
    const auto options = std::make_shared<ExportOptions>();
    add_scene_argument(*command, options->scene);
    command
        ->add_option_function<std::vector<std::string>>(
            "--engine",
            [options](const std::vector<std::string>& names) {
                options->engines.clear();
                for (const std::string& name : names)
                    options->engines.push_back(parse_engine(name));
            },
            "Engines, separated by commas: " + engine_names() + " (all)")
        ->delimiter(',')
        ->allow_extra_args(false) // a scene may follow
        ->type_name("ENGINE");
    command->add_option("-o,--output", options->output, "Write it here, not to the console")
        ->type_name("FILE")
        ->check(not_empty());
    add_scene_flags(*command, options->picture);
    add_timeout_flag(*command, options->timeout,
                     "Seconds above which it is given up (600; 0: any number)");
    return [options] {
        return guarded_within(options->timeout, options->scene,
                              [&](int /*watcher*/) { return export_view(*options); });
    };
}

} // namespace shadowproof
