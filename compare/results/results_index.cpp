#include "compare/results/results_index.h"

#include "compare/json/json_stream.h"
#include "compare/results/results_check.h"
#include "scenes/cause.h"
#include "scenes/load/gltf/memory.h"

#include <memory>
#include <utility>

namespace shadowproof {

namespace {

namespace fs = std::filesystem;
using Json = ResultsJson;

constexpr const char* remedy_for_memory = "join runs of fewer techniques, or of smaller pictures";

/// The word after "shadowproof verify", of a cell's command.
std::string verified_in(const Json& cell) {
    constexpr std::string_view begin = "shadowproof verify ";
    const auto& command = cell.at("command").get_ref<const std::string&>();
    if (!command.starts_with(begin)) return {};
    const std::string word = command.substr(begin.size());
    return word.substr(0, word.find(' '));
}

IndexedCell indexed(const Json& cell) {
    IndexedCell one{.name = cell.at("name").get<std::string>(),
                    .could_not_run = could_not_run(cell),
                    .fails = cell.at("fails") == true,
                    .verdict = cell.value("verdict", ""),
                    .verified = verified_in(cell)};
    if (!cell.contains("causes")) return one;
    for (const CauseWords& words : all_causes)
        if (cell.at("causes").contains(words.name))
            one.causes |= std::uint64_t{1} << static_cast<unsigned>(words.cause);
    return one;
}

/// A scene that was checked. Leaves it without its cells.
IndexedScene index_scene(Json& scene) {
    IndexedScene index;
    if (const auto cells = scene.find("techniques"); cells != scene.end()) {
        for (const Json& cell : *cells) index.cells.push_back(indexed(cell));
        *cells = Json::array();
    }
    index.head = std::move(scene);
    return index;
}

/// Where a scene stands in its file.
struct Range {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
};

/// Reads a file from its beginning to its end, and keeps what the index has of each scene.
class Reader {
public:
    Reader(const fs::path& file, JsonBytes& bytes, MemoryAccount& memory)
        : file_(file.string()), bytes_(bytes), memory_(memory), check_(file_) {}

    Json read() {
        bytes_.before_reading = [&] { require_memory_for_scene(); };
        const auto take = [&](int depth, Json::parse_event_t event, Json& value) {
            return taken(depth, event, value);
        };
        Json head = parsed(take);
        bytes_.before_reading = {};
        check_.end(head);
        return head;
    }

    std::vector<IndexedScene> scenes{};
    std::vector<Range> ranges{};

private:
    std::string file_;
    JsonBytes& bytes_;
    MemoryAccount& memory_;
    ResultsCheck check_;
    std::string member_{}; ///< of the whole, that is being read
    Json first_ = Json::object();
    bool has_scenes_ = false; ///< the member was begun
    bool in_scenes_ = false;  ///< in the list of scenes
    bool in_scene_ = false;
    std::uint64_t begin_ = 0; ///< of the scene that is being read
    gltf::JsonCounts counts_{};

    template <class Take>
    Json parsed(const Take& take) {
        try {
            return Json::parse(JsonByte(bytes_), JsonByte(), take);
        } catch (const Json::parse_error& error) {
            throw_not_json(file_, bytes_.size(), error.byte, results_remedies);
        } catch (const Json::out_of_range&) {
            throw Error(file_, "holds a number beyond every double", results_remedies.whole);
        }
    }

    bool taken(int depth, Json::parse_event_t event, Json& value) {
        using Event = Json::parse_event_t;
        if (depth > deepest_json)
            throw Error(file_, fmt::format("nests deeper than {}", deepest_json),
                        results_remedies.whole);
        count(event);
        if (depth == 1 && event == Event::key) begin_member(value.get<std::string>());
        if (depth == 1 && event == Event::value) check_early(value);
        if (depth == 1) in_scenes_ = member_ == "scenes" && event == Event::array_start;
        if (!in_scenes_ || depth != 2) return true;
        if (event == Event::object_start || event == Event::array_start) begin_scene();
        if (event == Event::object_end || event == Event::array_end || event == Event::value) {
            end_scene(value); // which is refused if it is no object
            return false;
        }
        return true;
    }

    void begin_member(std::string name) {
        member_ = std::move(name);
        if (member_ == "scenes" && std::exchange(has_scenes_, true))
            throw Error(file_, "/scenes stands there twice",
                        "write the results again with shadowproof verify");
    }

    /// What is no results file is refused before its scenes are looked at.
    void check_early(const Json& value) {
        if (member_ != "schema" && member_ != "format") return;
        first_[member_] = value;
        if (first_.size() == 2) check_schema(first_, file_);
    }

    void begin_scene() {
        in_scene_ = true;
        begin_ = bytes_.passed() - 1;
        counts_ = {};
    }

    void end_scene(Json& scene) {
        in_scene_ = false;
        check_.next(scene);
        ranges.push_back({begin_, bytes_.passed()});
        scenes.push_back(index_scene(scene));
        const IndexedScene& index = scenes.back();
        const std::string text = index.head.dump();
        memory_.keep({gltf::json_bytes(gltf::count_json(text, deepest_json)) +
                          index.cells.size() * (sizeof(IndexedCell) + 64),
                      file_, "what is known of its scenes", remedy_for_memory});
    }

    void count(Json::parse_event_t event) {
        using Event = Json::parse_event_t;
        counts_.values +=
            event == Event::value || event == Event::object_start || event == Event::array_start;
        counts_.containers += event == Event::object_start || event == Event::array_start;
        counts_.members += event == Event::key;
        counts_.strings += event == Event::key || event == Event::value;
    }

    /// As read, as merged, and as text again.
    void require_memory_for_scene() {
        counts_.bytes = bytes_.passed() - begin_;
        memory_.require({2 * gltf::json_bytes(counts_) + 4 * counts_.bytes, file_,
                         in_scene_ ? "one of its scenes" : "its values", remedy_for_memory});
    }
};

} // namespace

IndexedResults index_results(const fs::path& path, MemoryAccount& memory) {
    IndexedResults results;
    results.path = results_path(path);
    JsonBytes bytes(results.path, results_remedies);
    Reader reader(results.path, bytes, memory);
    results.head = reader.read();
    results.scenes = std::move(reader.scenes);
    // Not kept open: there may be more files than a process may open.
    results.scene = [file = results.path, ranges = std::move(reader.ranges)](std::size_t index) {
        const Range& range = ranges.at(index);
        Json scene = parse_json(json_slice(file, range.begin, range.end, results_remedies),
                                file.string(), results_remedies);
        ResultsCheck(file.string()).next(scene); // it may have changed
        return scene;
    };
    return results;
}

IndexedResults index_results(const ResultsFile& results) {
    IndexedResults index{.path = results.path, .head = results.json, .scenes = {}, .scene = {}};
    auto scenes = std::make_shared<Json>(std::exchange(index.head.at("scenes"), Json::array()));
    for (Json scene : *scenes) index.scenes.push_back(index_scene(scene));
    index.scene = [scenes](std::size_t number) { return scenes->at(number); };
    return index;
}

} // namespace shadowproof
