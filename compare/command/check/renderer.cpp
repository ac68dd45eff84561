#include "compare/command/check/renderer.h"

#include "compare/command/process/run_program.h"
#include "compare/command/view/view_json.h"
#include "compare/output/write_file.h"
#include "scenes/error.h"
#include "scenes/load/admission.h"
#include "scenes/load/catalog.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <system_error>

namespace shadowproof {

namespace {

namespace fs = std::filesystem;

const std::string pictures_folder = "rendered";

fs::path make_folder() {
    std::error_code failure;
    const fs::path below = fs::temp_directory_path(failure);
    std::string name = (below / "shadowproof-rendered-XXXXXX").string();
    if (failure || mkdtemp(name.data()) == nullptr)
        throw Error(name, fmt::format("cannot be made ({})", std::strerror(errno)),
                    "set TMPDIR to a folder that can be written");
    return name;
}

/// Each "{letters}" in a word becomes what `value` gives for the letters.
template <class Value>
std::string replaced(const std::string& word, const Value& value) {
    std::string made;
    for (std::size_t at = 0; at < word.size();) {
        const std::size_t end = word[at] == '{' ? word.find('}', at) : std::string::npos;
        const std::string name =
            end == std::string::npos ? std::string() : word.substr(at + 1, end - at - 1);
        const bool is_name = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
            return c >= 'a' && c <= 'z';
        });
        if (is_name)
            made += value(name);
        else
            made += word[at];
        at = is_name ? end + 1 : at + 1;
    }
    return made;
}

/// What a renderer is given: the scene's file, and the view as JSON.
struct ToldView {
    std::string file{};
    std::string json{};
};

SHADOWPROOF_SEND_ALL(ToldView, file, json)

ToldView view_of(const CheckOptions& options, const std::string& argument, Console& console) {
    return supervised({.timeout = options.timeout, .console = console}, [&](Pieces& pieces) {
        console.progress(argument + ": reading");
        return pieces.step(argument + ": reading", [&] {
            const Scene scene =
                in_file_units(load_scene(argument, drawn_by_others(options.view).request()));
            return ToldView{fs::absolute(scene.file).string(),
                            view_json(scene, options.view.time, {})
                                    .dump(1, ' ', false, nlohmann::json::error_handler_t::replace) +
                                "\n"};
        });
    });
}

std::string bytes_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// The end of what the program printed, in one line: errors are said last.
std::string last_words(const fs::path& log) {
    constexpr std::size_t most = 300; // characters
    std::string text = bytes_of(log);
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    if (text.size() > most) text = "..." + text.substr(text.size() - most);
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text.empty() ? "it said nothing" : "it said: " + text;
}

void require_end(const CheckOptions& options, const std::string& scene, const ProgramEnd& end,
                 const fs::path& log) {
    if (end.timed_out)
        throw Error(scene,
                    fmt::format("the renderer took longer than --timeout {} ({})", options.timeout,
                                last_words(log)),
                    "give it more seconds (0: any number), or a smaller --size");
    if (end.code != 0)
        throw Error(scene, fmt::format("the renderer {} ({})", words_of(end), last_words(log)),
                    "run it by hand: " + options.renderer);
}

/// A picture that a renderer wrote; it is looked at only if it is a file of some size.
void take_picture(const std::string& scene, const fs::path& file, const std::string& placeholder,
                  const fs::path& work, const fs::path& log, const ReportFolder& folder) {
    std::error_code failure;
    if (!fs::is_regular_file(file, failure) || fs::file_size(file, failure) == 0)
        throw Error(scene,
                    fmt::format("the renderer ended well, but wrote no {{{}}} ({})", placeholder,
                                last_words(log)),
                    "write a picture, .png, under the name that stands there");
    folder.add_file(fs::relative(file, work).generic_string(), bytes_of(file));
}

} // namespace

RenderFolder::RenderFolder()
    : path_(make_folder()), removal_([path = path_] {
          std::error_code ignored;
          fs::remove_all(path, ignored);
      }) {}

void require_command(const std::string& command) {
    bool writes = false;
    for (const std::string& word : split_words(command))
        replaced(word, [&](const std::string& name) {
            writes = writes || name == "out";
            if (name != "scene" && name != "view" && name != "out" && name != "unlit" &&
                name != "unshadowed")
                throw std::invalid_argument(
                    fmt::format("{{{}}} is not known; there are {{scene}}, {{view}}, {{out}}, "
                                "{{unlit}} and {{unshadowed}}",
                                name));
            return name;
        });
    if (!writes)
        throw std::invalid_argument("'" + command +
                                    "' writes no picture; put {out} where its file is named");
}

SceneInputs render_scene(const CheckOptions& options, const std::string& scene,
                         const std::string& name, const fs::path& work, const ReportFolder& folder,
                         Console& console) {
    const ToldView view = view_of(options, scene, console);
    const fs::path pictures = work / pictures_folder / name;
    fs::create_directories(pictures);
    const std::map<std::string, fs::path> values{{"scene", view.file},
                                                 {"view", pictures / "view.json"},
                                                 {"out", pictures / (options.name + ".png")},
                                                 {"unlit", pictures / "unlit.png"},
                                                 {"unshadowed", pictures / "unshadowed.png"}};
    write_file(values.at("view"), view.json);
    std::set<std::string> asked;
    std::vector<std::string> words = split_words(options.renderer);
    for (std::string& word : words)
        word = replaced(word, [&](const std::string& placeholder) {
            asked.insert(placeholder);
            return values.at(placeholder).string();
        });
    const fs::path log = work / "said";
    console.progress(scene + ": rendering");
    require_end(options, scene, run_program(words, log, options.timeout), log);
    const auto taken = [&](const std::string& placeholder) -> std::string {
        if (!asked.contains(placeholder)) return {};
        take_picture(scene, values.at(placeholder), placeholder, work, log, folder);
        return values.at(placeholder).string();
    };
    return {.scene = scene,
            .pictures = {taken("out")},
            .mask = {},
            .unlit = taken("unlit"),
            .unshadowed = taken("unshadowed"),
            .work = work};
}

std::string as_in_report(std::string message, const fs::path& work) {
    if (work.empty()) return message;
    const std::string prefix = work.string() + "/";
    for (std::size_t at = 0; (at = message.find(prefix, at)) != std::string::npos;)
        message.erase(at, prefix.size());
    return message;
}

} // namespace shadowproof
