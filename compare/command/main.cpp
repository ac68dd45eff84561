#include "compare/command/commands.h"
#include "compare/command/guard.h"
#include "compare/command/manual/bash_completion.h"
#include "compare/command/manual/command_line.h"
#include "compare/command/manual/examples.h"
#include "compare/command/manual/man_page.h"
#include "compare/command/process/exit_code.h"
#include "compare/command/process/signals.h"
#include "compare/command/process/standard_output.h"
#include "compare/command/wrapped.h"
#include "raster/gl/context.h"
#include "reference/trace/trace.h"
#include "reference/walk/instruction_set.h"
#include "scenes/error.h"
#include "scenes/load/common/nearest_name.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <sstream>

using namespace shadowproof;

namespace {

constexpr const char* description =
    "Which pixels of a rasterized shadow are wrong, why, and would your build have caught it? For "
    "a glTF scene, shadowproof decides exactly at each pixel whether the light is seen, renders "
    "the scene with the classic shadow techniques through OpenGL, and names the cause of every "
    "pixel that differs.";

/// OpenGL's driver, or why there is none.
std::string driver_in_words() {
    try {
        const DriverInfo driver = Gpu(GlPlatform::osmesa).driver();
        return fmt::format("{}, {}", driver.version, driver.renderer);
    } catch (const Error& error) {
        return fmt::format("none ({})", error.what());
    }
}

/// What the results of a run depend on.
std::string versions() {
    choose_instruction_set();
    return fmt::format("shadowproof {}\nEmbree {}\nOpenGL {}\ninstruction set {}",
                       SHADOWPROOF_VERSION, embree_version(), driver_in_words(),
                       instruction_set_in_use());
}

/// For the first word of the command line that looks like a flag and is none of the command's.
std::string flag_that_was_meant(const CLI::App& command, int argc, char** argv) {
    std::vector<std::string> flags{"--help"};
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
    for (int i = 1; i < argc; ++i) {
        const std::string_view word(argv[i]);
        const std::string flag(word.substr(0, word.find('=')));
        if (!flag.starts_with("--") || std::ranges::count(flags, flag) > 0) continue;
        return did_you_mean(flag, flags);
    }
    return {};
}

/// Flags that print what the installation has in files.
void add_manual_flags(CLI::App& app) {
    const auto printed = [&app](const char* flag, const char* words, const auto& text) {
        app.add_flag_callback(
            flag,
            [text] {
                print(text());
                throw CLI::Success();
            },
            words);
    };
    printed("--completion", "Print the script that completes command lines in bash",
            [&app] { return bash_completion(command_line_of(app)); });
    printed("--man-page", "Print the manual page, for man",
            [&app] { return man_page(command_line_of(app), SHADOWPROOF_VERSION); });
}

int run(int argc, char** argv) {
    CLI::App app(description, "shadowproof");
    app.require_subcommand(1);
    app.set_version_flag("--version", versions);
    const std::vector<Work> works{add_verify(app),  add_check(app),       add_render(app),
                                  add_explain(app), add_stress(app),      add_bench(app),
                                  add_list(app),    add_report(app),      add_merge(app),
                                  add_accept(app),  add_export_view(app), add_normal_map(app)};
    const std::vector<CLI::App*> commands = app.get_subcommands([](CLI::App*) { return true; });
    app.footer(help_footer("")); // here, or the subcommands would inherit it
    for (CLI::App* command : commands) {
        command->footer(help_footer(command->get_name()));
        // The name of an argument says what it is.
        for (CLI::Option* option : command->get_options())
            if (option->get_positional()) option->type_name("");
    }
    add_manual_flags(app);
    std::string offered;
    std::vector<std::string> names;
    for (const CLI::App* command : commands) names.push_back(command->get_name());
    for (const CLI::App* command : commands)
        offered += (offered.empty() ? "" : ", ") + command->get_name();
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& success) {
        std::ostringstream words;
        const int code = app.exit(success, words, words);
        print(wrapped(words.str(), 80));
        return code;
    } catch (const CLI::ParseError& error) {
        const std::vector<CLI::App*> chosen = app.get_subcommands();
        const std::string_view first = argc > 1 ? argv[1] : "";
        if (!chosen.empty()) {
            complain(error.what() + flag_that_was_meant(*chosen.front(), argc, argv));
            std::cerr << "See shadowproof " << chosen.front()->get_name() << " --help.\n";
        } else if (first.empty() || first.front() == '-') {
            complain(fmt::format("{}; there are {}", error.what(), offered));
        } else {
            complain(fmt::format("there is no command '{}'{}; there are {}", first,
                                 did_you_mean(first, names), offered));
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
