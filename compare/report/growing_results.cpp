#include "compare/report/growing_results.h"

#include "compare/report/report.h"
#include "compare/report/report_data.h"

#include <fmt/format.h>

#include <utility>

namespace shadowproof {

namespace {

constexpr const char* scenes_member = "scenes";

/// The value as results_text has it where it stands `depth` levels deep. JSON has line ends between
/// values alone.
std::string text_of(const ResultsJson& value, std::size_t depth) {
    std::string text;
    for (const char c : value.dump(1, ' ', false, ResultsJson::error_handler_t::replace)) {
        text += c;
        if (c == '\n') text.append(depth, ' ');
    }
    return text;
}

std::string quoted(const std::string& name) {
    return ResultsJson(name).dump();
}

} // namespace

GrowingResults::GrowingResults(ReplacedFolder& files, ResultsJson head,
                               const std::optional<std::string>& requested)
    : head_(std::move(head)), script_(files.grow(results_script_name)) {
    texts_.push_back(files.grow(results_name));
    if (requested) texts_.push_back(files.grow_requested(*requested));
    write("{");
    script_.write("shadowproof.results({");
    write_members(false);
}

void GrowingResults::write(std::string_view text) {
    for (ReplacedFolder::GrowingFile& file : texts_) file.write(text);
}

/// The head's members up to the scenes' list, which it opens, or those behind it.
void GrowingResults::write_members(bool behind_scenes) {
    bool behind = false;
    bool first = !behind_scenes;
    for (const auto& [name, value] : head_.items()) {
        const bool is_scenes = name == scenes_member;
        if (behind == behind_scenes && !(is_scenes && behind_scenes)) {
            const char* const comma = first ? "" : ",";
            first = false;
            write(fmt::format("{}\n {}: ", comma, quoted(name)));
            script_.write(fmt::format("{}{}:", comma, quoted(name)));
            write(is_scenes ? "[" : text_of(value, 1));
            script_.write(is_scenes ? "[" : value.dump());
        }
        behind = behind || is_scenes;
    }
}

void GrowingResults::add(const ResultsJson& scene) {
    write((empty_ ? "\n  " : ",\n  ") + text_of(scene, 2));
    script_.write((empty_ ? "" : ",") + quoted(packed_scene(scene)));
    empty_ = false;
}

void GrowingResults::end() {
    write(empty_ ? "]" : "\n ]");
    script_.write("]");
    write_members(true);
    write("\n}\n");
    script_.write("});\n");
    for (ReplacedFolder::GrowingFile& file : texts_) file.end();
    script_.end();
}

} // namespace shadowproof
