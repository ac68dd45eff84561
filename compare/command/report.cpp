#include "compare/command/commands.h"
#include "compare/command/rebuild.h"

#include <CLI/CLI.hpp>
#include <memory>

namespace shadowproof {

Work add_report(CLI::App& app) {
    CLI::App* command = app.add_subcommand("report", "The report again, from results and pictures");
    const auto options = std::make_shared<RebuildOptions>();
    command
        ->add_option_function<std::string>(
            "--from", [options](const std::string& path) { options->from = {path}; },
            "A results.json beside its pictures, or the folder of a report")
        ->type_name("FILE")
        ->required()
        ->check(not_empty());
    add_rebuild_flags(*command, *options);
    return [options] { return rebuild(*options); };
}

} // namespace shadowproof
