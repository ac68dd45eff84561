#include "compare/command/commands.h"
#include "compare/command/console.h"
#include "compare/memory.h"
#include "compare/unfinished.h"
#include "reference/trace.h"

#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

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
    "  shadowproof explain near_plane --pixel 229,103  why one pixel is what it is\n"
    "  shadowproof render ordinary -o truth.png        the truth as a picture\n"
    "  shadowproof normal-map height.png -o normal.png a height field as a normal map\n"
    "  shadowproof merge shard-1 shard-2 --out report  the runs of two machines as one\n"
    "\nExit codes:\n"
    "  0  every technique agrees with the truth, or fails as was predicted\n"
    "  1  a defect, an unexplained pixel, or a scene that stopped provoking its causes\n"
    "  2  wrong usage\n"
    "  3  could not run: unreadable scene, no OpenGL, a blank or NaN render\n";

int run(int argc, char** argv) {
    CLI::App app(description, "shadowproof");
    app.require_subcommand(1);
    app.set_version_flag("--version", [] {
        return fmt::format("shadowproof {}\nEmbree {}", SHADOWPROOF_VERSION, embree_version());
    });
    const std::vector<Work> works{add_verify(app),    add_render(app), add_explain(app),
                                  add_list(app),      add_report(app), add_merge(app),
                                  add_normal_map(app)};
    app.footer(footer); // here, or the subcommands would inherit it
    const std::vector<CLI::App*> commands = app.get_subcommands([](CLI::App*) { return true; });
    std::string offered;
    for (const CLI::App* command : commands)
        offered += (offered.empty() ? "" : ", ") + command->get_name();
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& success) {
        return app.exit(success);
    } catch (const CLI::ParseError& error) {
        const std::vector<CLI::App*> chosen = app.get_subcommands();
        const std::string_view first = argc > 1 ? argv[1] : "";
        if (!chosen.empty()) {
            complain(error.what());
            fmt::print(stderr, "See shadowproof {} --help.\n", chosen.front()->get_name());
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
    remove_unfinished_at_signals();
    // Who closes the pipe that we print into ends the run as an error does, not by a signal.
    std::signal(SIGPIPE, SIG_IGN);
    try {
        return run(argc, argv);
    } catch (const std::bad_alloc&) {
        complain(out_of_memory);
    } catch (const std::exception& error) {
        complain(error.what());
    }
    return exit_could_not;
}
