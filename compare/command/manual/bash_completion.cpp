#include "compare/command/manual/bash_completion.h"

#include "raster/technique.h"
#include "scenes/cause.h"
#include "scenes/engines/convention.h"
#include "scenes/load/catalog.h"
#include "scenes/stress/parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

namespace shadowproof {

namespace {

template <class All>
std::string names_in(const All& all, std::string_view end = "") {
    std::string names;
    for (const auto& one : all)
        names += fmt::format("{}{}{}", names.empty() ? "" : " ", one.name, end);
    return names;
}

/// What may stand where the help shows `value`, as an assignment in the script; empty: anything.
std::string offered_for(const std::string& value) {
    constexpr std::array files{"FILE", "IMAGE", "RESULTS", "HEIGHT"};
    if (value == "SCENE") return "kind=scene";
    if (value == "DIR") return "kind=folder";
    if (std::ranges::count(files, value) > 0) return "kind=file";
    if (value == "TECHNIQUE") return "words='" + names_in(all_techniques()) + "'";
    if (value == "ENGINE") return "words='" + names_in(conventions()) + "'";
    if (value == "PARAMETER") return "words='" + names_in(stress_parameters()) + "'";
    if (value == "PARAMETER=VALUE") return "words='" + names_in(stress_parameters(), "=") + "'";
    if (value.starts_with("CAUSE=")) return "words='" + names_in(all_causes, "=") + "'";
    if (value.starts_with("CAUSE")) return "words='" + names_in(all_causes) + "'";
    if (value.find('|') == std::string::npos) return {};
    std::string words = value;
    std::ranges::replace(words, '|', ' ');
    return "words='" + words + "'";
}

/// The branches that say what follows an option: one for each answer, by command and option.
std::string value_branches(std::span<const CommandWords> commands) {
    std::map<std::string, std::string> patterns; // by assignment
    for (const CommandWords& command : commands)
        for (const OptionWords& option : command.options) {
            if (option.value.empty()) continue;
            const std::string offered = offered_for(option.value);
            const std::string assignment = offered.empty() ? "kind=any" : offered;
            std::string& pattern = patterns[assignment + (option.is_list ? " list=1" : "")];
            for (const std::string& name : option.names)
                pattern += fmt::format("{}'{} {}'", pattern.empty() ? "" : "|", command.name, name);
        }
    std::string text;
    for (const auto& [assignment, pattern] : patterns)
        text += fmt::format("    {}) {} ;;\n", pattern, assignment);
    return text;
}

std::string options_of(const CommandWords& command) {
    std::string names;
    for (const OptionWords& option : command.options)
        for (const std::string& name : option.names) names += (names.empty() ? "" : " ") + name;
    return names;
}

/// The branches that say which options and arguments a command has.
std::string command_branches(std::span<const CommandWords> commands) {
    std::string text;
    for (const CommandWords& command : commands) {
        std::string arguments =
            command.name.empty() ? "words='" + names_in(commands.subspan(1)) + "'" : "kind=any";
        if (!command.arguments.empty())
            arguments = offered_for(command.arguments.front().names.front());
        text += fmt::format("    '{}') options='{}' {} ;;\n", command.name, options_of(command),
                            arguments);
    }
    return text;
}

constexpr std::string_view script_begin =
    R"(# Completion for bash; made by shadowproof --completion.
_shadowproof() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}
    # bash takes --gl=egl for three words.
    if [[ $word == = ]]; then
        word=
    elif [[ $before == = ]]; then
        before=${COMP_WORDS[COMP_CWORD-2]}
    fi
    local command= i
    for ((i = 1; i < COMP_CWORD; ++i)); do
        if [[ ${COMP_WORDS[i]} != -* ]]; then
            command=${COMP_WORDS[i]}
            break
        fi
    done
    local options= words= kind= list= head=
    COMPREPLY=()
)";

constexpr std::string_view script_middle = R"(    esac
    if [[ -z $kind$words ]]; then
        case $command in
)";

constexpr std::string_view script_end = R"(        esac
        [[ $word == -* ]] && words=$options kind=
    elif [[ -n $list ]]; then
        head=${word%"${word##*,}"} word=${word##*,}
    fi
    [[ $kind == scene ]] && words=$scenes
    mapfile -t COMPREPLY < <(
        [[ -n $words ]] && compgen -P "$head" -W "$words" -- "$word"
        case $kind in
        file) compgen -f -- "$word" ;;
        folder) compgen -d -- "$word" ;;
        scene)
            compgen -d -- "$word"
            for i in gltf glb md2 png jpg exr hdr; do compgen -f -X "!*.$i" -- "$word"; done ;;
        esac)
    # Where bash completes, and not a test.
    case $kind in file|folder|scene) compopt -o filenames 2>/dev/null ;; esac
    [[ ${COMPREPLY[0]} == *= ]] && compopt -o nospace 2>/dev/null
    return 0
}
complete -F _shadowproof shadowproof
)";

} // namespace

std::string bash_completion(std::span<const CommandWords> commands) {
    std::string text(script_begin);
    text += fmt::format("    local scenes='{}'\n", names_in(bundled_scenes()));
    text += "    case \"$command $before\" in\n";
    text += value_branches(commands);
    text += script_middle;
    text += command_branches(commands);
    text += script_end;
    return text;
}

} // namespace shadowproof
