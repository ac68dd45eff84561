#include "compare/report/shared_files.h"

#include <fmt/format.h>

#include <map>
#include <vector>

namespace shadowproof {

namespace {

constexpr std::string_view reference_begin = R"({"from":")";
constexpr std::string_view reference_end = R"("})";
/// A block as short as that stays where it is.
constexpr std::size_t least_shared = 100; // bytes

/// A line of a script that has a block: compare/report/report_data.cpp gives each its own.
struct BlockLine {
    std::string_view name;
    std::string_view block;
    std::string_view end; ///< of the line, or of the script
};

/// The script up to its blocks, and those; no blocks where it is not as it was written.
struct SplitScript {
    std::string_view head;
    std::vector<BlockLine> blocks;
};

SplitScript split(std::string_view script) {
    constexpr std::string_view begin = "\"blocks\":{\n";
    constexpr std::string_view last_end = "}});\n";
    const std::size_t at = script.find(begin);
    if (at == std::string_view::npos) return {script, {}};
    SplitScript parts{script.substr(0, at + begin.size()), {}};
    std::string_view left = script.substr(at + begin.size());
    while (!left.empty()) {
        const std::string_view line = left.substr(0, left.find('\n') + 1);
        const std::string_view end = line.ends_with(last_end) ? last_end : ",\n";
        const std::size_t colon = line.find("\":");
        if (line.empty() || !line.ends_with(end) || !line.starts_with('"') ||
            colon == std::string_view::npos)
            return {script, {}};
        parts.blocks.push_back({line.substr(1, colon - 1),
                                line.substr(colon + 2, line.size() - colon - 2 - end.size()), end});
        left.remove_prefix(line.size());
    }
    return parts;
}

std::string joined(const SplitScript& parts) {
    std::string script(parts.head);
    for (const BlockLine& line : parts.blocks)
        script += fmt::format("\"{}\":", line.name).append(line.block).append(line.end);
    return script;
}

/// "zpass/seen", of a block that stands elsewhere; else empty.
std::string_view reference_in(std::string_view block) {
    if (!block.starts_with(reference_begin) || !block.ends_with(reference_end)) return {};
    return block.substr(reference_begin.size(),
                        block.size() - reference_begin.size() - reference_end.size());
}

/// "zpass" of "spot/zpass.cell.js".
std::string technique_of(const std::string& script) {
    constexpr std::string_view end = ".cell.js";
    const std::size_t begin = script.rfind('/') + 1;
    return script.substr(begin, script.size() - end.size() - begin);
}

/// Where the same bytes stand: `here`, unless they stood elsewhere before.
template <class Places>
const std::string& first_place(Places& places, std::string_view bytes, const std::string& here) {
    const Fingerprint print = fingerprint_of(bytes);
    return places.try_emplace({print.size, print.xxh3}, here).first->second;
}

} // namespace

void SharedFiles::enter_folder_of(const std::string& path) {
    std::string folder = path.substr(0, path.find('/'));
    if (folder == folder_) return;
    folder_ = std::move(folder);
    pictures_.clear();
    blocks_.clear();
}

std::string SharedFiles::place_of(const std::string& path, std::string_view bytes) {
    enter_folder_of(path);
    return first_place(pictures_, bytes, path);
}

std::string SharedFiles::shared(const std::string& path, const std::string& script) {
    enter_folder_of(path);
    SplitScript parts = split(script);
    std::vector<std::string> references(parts.blocks.size()); // as long as the lines that use them
    for (std::size_t i = 0; i < parts.blocks.size(); ++i) {
        BlockLine& line = parts.blocks[i];
        if (line.block.size() < least_shared) continue;
        const std::string here = fmt::format("{}/{}", technique_of(path), line.name);
        const std::string& first = first_place(blocks_, line.block, here);
        if (first == here) continue;
        references[i] = fmt::format("{}{}{}", reference_begin, first, reference_end);
        line.block = references[i];
    }
    return joined(parts);
}

std::string with_own_blocks(const std::string& script,
                            const std::function<std::string(const std::string&)>& script_of) {
    SplitScript parts = split(script);
    std::map<std::string, std::string, std::less<>> others; // scripts by technique
    for (BlockLine& line : parts.blocks) {
        const std::string_view reference = reference_in(line.block);
        const std::size_t slash = reference.find('/');
        if (slash == std::string_view::npos) continue;
        const std::string technique(reference.substr(0, slash));
        const auto [other, is_new] = others.try_emplace(technique);
        if (is_new) other->second = script_of(technique);
        for (const BlockLine& each : split(other->second).blocks)
            if (each.name == reference.substr(slash + 1)) line.block = each.block;
    }
    return joined(parts);
}

std::string lacking_blocks(std::string_view script) {
    for (const BlockLine& line : split(script).blocks)
        if (const std::string_view reference = reference_in(line.block); !reference.empty())
            return fmt::format("is damaged: its block {} stands in {}, which is not there",
                               line.name, reference);
    return {};
}

} // namespace shadowproof
