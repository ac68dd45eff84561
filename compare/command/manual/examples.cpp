#include "compare/command/manual/examples.h"

#include <fmt/format.h>

#include <array>

namespace shadowproof {

namespace {

constexpr auto examples = std::to_array<CommandExample>({
    {"verify", "shadowproof verify", "every bundled scene, the report in report/"},
    {"verify", "shadowproof verify my.glb --technique zfail,auto",
     "two techniques on a scene of your own"},
    {"verify", "shadowproof verify my.glb --gate differences --baseline accepted.json",
     "fail on what an earlier, accepted run did not have"},
    {"verify", "shadowproof verify *.glb --shard 2/4 --out part-2 --resume",
     "the second of four parts, going on where it was cut off"},
    {"check", "shadowproof check my.glb mine.png --unlit off.png",
     "the picture that your renderer made"},
    {"check", "shadowproof check my.glb --renderer './render {scene} {view} {out}'",
     "let the renderer make it"},
    {"render", "shadowproof render ordinary -o truth.png", "the truth as a picture"},
    {"render", "shadowproof render ordinary -o truth.exr", "the truth with all that it rests on"},
    {"explain", "shadowproof explain near_plane --pixel 229,103", "why one pixel is what it is"},
    {"explain", "shadowproof explain near_plane --pixel 229,103 --svg story.svg",
     "the same as a drawing"},
    {"stress", "shadowproof stress near_plane", "where each technique starts to fail"},
    {"stress", "shadowproof stress ordinary --parameter near_plane --technique zfail",
     "one technique along one parameter"},
    {"bench", "shadowproof bench ordinary --quick", "error against run time"},
    {"list", "shadowproof list", "all scenes, techniques and causes"},
    {"list", "shadowproof list --json", "the same for programs"},
    {"report", "shadowproof report --from report --out again", "the report written again"},
    {"merge", "shadowproof merge part-1 part-2 --out report", "the runs of two machines as one"},
    {"accept", "shadowproof accept report -o accepted.json", "what was reviewed, as a baseline"},
    {"export-view", "shadowproof export-view my.glb --engine three",
     "its camera and light, for three.js"},
    {"normal-map", "shadowproof normal-map height.png -o normal.png",
     "a height field as a normal map"},
});

constexpr auto exit_codes = std::to_array<ExitCodeWords>({
    {0, "every technique agrees with the truth, or fails as was predicted"},
    {1, "a defect, an unexplained pixel, a cell above --timeout, or a scene that stopped "
        "provoking its causes"},
    {2, "wrong usage"},
    {3, "could not run: unreadable scene, no OpenGL, a blank or NaN render"},
});

} // namespace

std::span<const CommandExample> command_examples() {
    return examples;
}

std::span<const ExitCodeWords> exit_code_words() {
    return exit_codes;
}

std::string help_footer(std::string_view command) {
    std::string text = "Examples:\n";
    std::string_view before;
    for (const CommandExample& example : examples) {
        const bool is_first = example.command != before;
        before = example.command;
        if (command.empty() ? is_first : example.command == command)
            text += fmt::format("  {}\n      {}\n", example.words, example.meaning);
    }
    if (!command.empty()) return text;
    text += "\nExit codes:\n";
    for (const ExitCodeWords& words : exit_codes)
        text += fmt::format("  {}  {}\n", words.code, words.meaning);
    return text + "\nshadowproof COMMAND --help tells the options of a command.\n";
}

} // namespace shadowproof
