#include "compare/command/manual/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

namespace shadowproof {

namespace {

/// CLI11's words for a range, "INT in [1 - 1024]", as "1 to 1024".
std::string limits_in_words(const std::string& range) {
    const std::size_t begin = range.find('[');
    const std::size_t gap = range.find(" - ");
    if (begin == std::string::npos || gap == std::string::npos || gap < begin) return {};
    return fmt::format("{} to {}", range.substr(begin + 1, gap - begin - 1),
                       range.substr(gap + 3, range.size() - gap - 4));
}

OptionWords words_of(const CLI::Option& option) {
    OptionWords words{.description = option.get_description(),
                      .is_required = option.get_required(),
                      .is_repeated = option.get_items_expected_max() > 1,
                      .is_list = option.get_delimiter() != '\0'};
    if (option.get_positional()) {
        words.names.push_back(option.get_name(true));
        return words;
    }
    for (const std::string& name : option.get_snames()) words.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) words.names.push_back("--" + name);
    if (option.get_items_expected_max() > 0) {
        const std::string type = option.get_type_name();
        const std::size_t colon = std::min(type.find(':'), type.size());
        words.value = type.substr(0, colon);
        words.limits = limits_in_words(type.substr(colon));
    }
    for (const CLI::Option* other : option.get_excludes())
        words.not_with += (words.not_with.empty() ? "" : ", ") + other->get_name();
    return words;
}

CommandWords words_of(const CLI::App& app, const std::string& name) {
    CommandWords words{.name = name, .description = app.get_description()};
    for (const CLI::Option* option : app.get_options())
        (option->get_positional() ? words.arguments : words.options).push_back(words_of(*option));
    return words;
}

} // namespace

std::vector<CommandWords> command_line_of(const CLI::App& app) {
    std::vector<CommandWords> commands{words_of(app, "")};
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        commands.push_back(words_of(*command, command->get_name()));
    return commands;
}

} // namespace shadowproof
