#include "compare/command/commands.h"
#include "compare/command/rebuild.h"

#include <CLI/CLI.hpp>
#include <memory>

namespace shadowproof {

Work add_merge(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("merge", "One report of several runs: the shards of one, or others");
    const auto options = std::make_shared<RebuildOptions>();
    options->what = Rebuilt::several;
    command
        ->add_option("RESULTS", options->from,
                     "Folders of reports, or results.json files beside their pictures")
        ->required()
        ->check(not_empty());
    command->add_option("--json", options->json, "Also write the results here")
        ->type_name("FILE")
        ->check(not_empty());
    add_rebuild_flags(*command, *options);
    return [options] { return rebuild(*options); };
}

} // namespace shadowproof
