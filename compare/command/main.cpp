#include "compare/command/commands.h"
#include "compare/command/guard.h"
#include "compare/command/process/exit_code.h"
#include "compare/command/process/signals.h"
#include "compare/command/process/standard_output.h"
#include "reference/trace/trace.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <sstream>

using namespace shadowproof;

namespace {

constexpr const char* description =
    "Which pixels of a rasterized shadow are wrong, why, and would your build have caught it?\n"
    "For a glTF scene, shadowproof decides exactly at each pixel whether the light is seen,\n"
    "renders the scene with the classic shadow techniques through OpenGL, and names the cause\n"
    "of every pixel that differs.\n";

constexpr const char* footer =
    "\nExamples:\n"
    "  shadowproof verify                              every bundled scene, report in report/\n"
    "  shadowproof verify my.glb --technique zfail     one technique on a scene of your own\n"
    "  shadowproof check my.glb mine.png --unlit off.png   the picture that your renderer made\n"
    "  shadowproof export-view my.glb --engine three   its camera and light, for three.js\n"
    "  shadowproof stress near_plane                   where each technique starts to fail\n"
    "  shadowproof bench ordinary --quick              error against run time\n"
    "  shadowproof explain near_plane --pixel 229,103  why one pixel is what it is\n"
    "  shadowproof render ordinary -o truth.png        the truth as a picture\n"
    "  shadowproof normal-map height.png -o normal.png a height field as a normal map\n"
    "  shadowproof merge shard-1 shard-2 --out report  the runs of two machines as one\n"
    "  shadowproof accept report -o accepted.json      what was reviewed, as a baseline\n"
    "\nExit codes:\n"
    "  0  every technique agrees with the truth, or fails as was predicted\n"
    "  1  a defect, an unexplained pixel, a cell above --timeout, or a scene that stopped\n"
    "     provoking its causes\n"
    "  2  wrong usage\n"
    "  3  could not run: unreadable scene, no OpenGL, a blank or NaN render\n";

int run(int argc, char** argv) {
    CLI::App app(description, "shadowproof");
    app.require_subcommand(1);
    app.set_version_flag("--version", [] {
        return fmt::format("shadowproof {}\nEmbree {}", SHADOWPROOF_VERSION, embree_version());
    });
    const std::vector<Work> works{add_verify(app),  add_check(app),       add_render(app),
                                  add_explain(app), add_stress(app),      add_bench(app),
                                  add_list(app),    add_report(app),      add_merge(app),
                                  add_accept(app),  add_export_view(app), add_normal_map(app)};
    app.footer(footer); // here, or the subcommands would inherit it
    const std::vector<CLI::App*> commands = app.get_subcommands([](CLI::App*) { return true; });
    std::string offered;
    for (const CLI::App* command : commands)
        offered += (offered.empty() ? "" : ", ") + command->get_name();
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& success) {
        std::ostringstream words;
        const int code = app.exit(success, words, words);
        print(words.str());
        return code;
    } catch (const CLI::ParseError& error) {
        const std::vector<CLI::App*> chosen = app.get_subcommands();
        const std::string_view first = argc > 1 ? argv[1] : "";
        if (!chosen.empty()) {
            complain(error.what());
            std::cerr << "See shadowproof " << chosen.front()->get_name() << " --help.\n";
        } else if (first.empty() || first.front() == '-') {
            complain(fmt::format("{}; there are {}", error.what(), offered));
        } else {
            complain(fmt::format("there is no command '{}'; there are {}", first, offered));
        }
        return exit_usage;
    }
    for (std::size_t i = 0; i < commands.size(); ++i)
        if (commands[i]->parsed()) return works[i]();
    return exit_usage;
}

} // namespace

int main(int argc, char** argv) {
    open_standard_streams();
    return run_to_exit_code([&] {
        handle_signals();
        return run(argc, argv);
    });
}
