#include "compare/command/manual/man_page.h"

#include "compare/command/manual/examples.h"

#include <fmt/format.h>

namespace shadowproof {

namespace {

/// Text in which roff sees no command: an escaped backslash, hyphens that can be copied, and no
/// full stop or apostrophe that begins a line.
std::string plain(std::string_view text) {
    std::string result;
    for (const char c : text) {
        const bool begins_line = result.empty() || result.back() == '\n';
        if (begins_line && (c == '.' || c == '\'')) result += "\\&";
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else
            result += c;
    }
    return result;
}

std::string bold(std::string_view text) {
    return "\\fB" + plain(text) + "\\fR";
}

std::string italic(std::string_view text) {
    return "\\fI" + plain(text) + "\\fR";
}

std::string sentence(const OptionWords& option) {
    std::string text = option.description;
    if (!option.limits.empty()) text += "; " + option.limits;
    if (!option.not_with.empty()) text += "; not with " + option.not_with;
    return text;
}

std::string option_entry(const OptionWords& option) {
    std::string names;
    for (const std::string& name : option.names) names += (names.empty() ? "" : ", ") + bold(name);
    if (!option.value.empty()) names += " " + italic(option.value);
    if (option.is_required) names += " (required)";
    return fmt::format(".TP\n{}\n{}\n", names, plain(sentence(option)));
}

/// "SCENE [IMAGE...]"
std::string usage(const OptionWords& argument) {
    const std::string name = argument.names.front() + (argument.is_repeated ? "..." : "");
    return argument.is_required ? name : "[" + name + "]";
}

std::string command_section(const CommandWords& command) {
    std::string text =
        fmt::format(".SS {}\n{}.\n.PP\n{}", plain(command.name), plain(command.description),
                    bold("shadowproof " + command.name) + " [" + italic("OPTION") + "...]");
    for (const OptionWords& argument : command.arguments) text += " " + italic(usage(argument));
    text += "\n";
    for (const OptionWords& argument : command.arguments)
        text += fmt::format(".TP\n{}\n{}\n", italic(argument.names.front()),
                            plain(argument.description));
    for (const OptionWords& option : command.options) text += option_entry(option);
    return text;
}

std::string example_section() {
    std::string text = ".SH EXAMPLES\n";
    for (const CommandExample& example : command_examples())
        text += fmt::format(".TP\n{}\n{}\n", bold(example.words), plain(example.meaning));
    return text;
}

std::string exit_section() {
    std::string text = ".SH EXIT STATUS\n";
    for (const ExitCodeWords& words : exit_code_words())
        text += fmt::format(".TP\n{}\n{}\n", words.code, plain(words.meaning));
    return text;
}

} // namespace

std::string man_page(std::span<const CommandWords> commands, const std::string& version) {
    const CommandWords& program = commands.front();
    std::string text =
        fmt::format(".TH SHADOWPROOF 1 \"\" \"shadowproof {}\" \"User Commands\"\n"
                    ".SH NAME\nshadowproof \\- exact verification of rasterized shadows\n"
                    ".SH SYNOPSIS\n{} {} [{}...] [{}...]\n.SH DESCRIPTION\n{}\n.SH OPTIONS\n",
                    version, bold("shadowproof"), italic("COMMAND"), italic("OPTION"),
                    italic("ARGUMENT"), plain(program.description));
    for (const OptionWords& option : program.options) text += option_entry(option);
    text += ".SH COMMANDS\n";
    for (const CommandWords& command : commands.subspan(1)) text += command_section(command);
    return text + exit_section() + example_section();
}

} // namespace shadowproof
