// The command line as plain text: its commands, their arguments and options, as CLI11 has them.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace shadowproof {

/// An option, or a positional argument.
struct OptionWords {
    std::vector<std::string> names{}; ///< "-q", "--quiet"; of a positional argument "SCENE"
    std::string value{};              ///< what follows, as "N"; empty: nothing
    std::string limits{};             ///< of a number, as "1 to 1024"; else empty
    std::string description{};
    std::string not_with{}; ///< options that exclude it, as "--unlit"
    bool is_required = false;
    bool is_repeated = false; ///< any number may be given
    bool is_list = false;     ///< values may be separated by commas
};

struct CommandWords {
    std::string name{}; ///< empty: what stands before any command
    std::string description{};
    std::vector<OptionWords> arguments{};
    std::vector<OptionWords> options{};
};

/// All commands in their order, after that without a name.
std::vector<CommandWords> command_line_of(const CLI::App& app);

} // namespace shadowproof
