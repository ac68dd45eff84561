#include "compare/command/check/pictures.h"

#include "scenes/error.h"

#include <fmt/format.h>

#include <utility>

namespace shadowproof {

namespace {

/// Its pixels stay in the account.
Picture read(const std::string& file, MemoryAccount& memory) {
    constexpr std::uint64_t most_pixels = std::uint64_t{1} << 28;
    Picture picture = read_picture(file, {.memory = memory, .most_pixels = most_pixels});
    memory.keep({picture.values.size() * sizeof(float), file, "its pixels",
                 "check fewer pictures at once"});
    return picture;
}

void require_size(const std::string& file, const Picture& picture, int width, int height) {
    if (picture.width == width && picture.height == height) return;
    throw Error(
        file,
        fmt::format("is {}x{}, where {}x{} belongs", picture.width, picture.height, width, height),
        "render all pictures of a scene at one size, or check them one by one");
}

} // namespace

const std::string& judged_file(const SceneInputs& inputs, std::size_t i) {
    return inputs.mask.empty() ? inputs.pictures[i] : inputs.mask;
}

Pictures read_pictures(const CheckOptions& options, const SceneInputs& inputs,
                       MemoryAccount& memory, Console& console, Pieces& pieces) {
    const auto read_one = [&](const std::string& file) {
        console.progress(file + ": reading");
        return pieces.step(file + ": reading", [&] { return read(file, memory); });
    };
    Pictures all;
    for (std::size_t i = 0; i < inputs.pictures.size(); ++i)
        all.pictures.push_back(read_one(judged_file(inputs, i)));
    const PictureSize first{all.pictures.front().width, all.pictures.front().height};
    all.size = options.with_size ? options.view.size : first;
    const auto [width, height] = all.size;
    for (std::size_t i = 0; i < all.pictures.size(); ++i)
        require_size(judged_file(inputs, i), all.pictures[i], width, height);
    for (const auto& [file, twin] : {std::pair(&inputs.unlit, &all.twins.unlit),
                                     {&inputs.unshadowed, &all.twins.unshadowed}}) {
        if (file->empty()) continue;
        *twin = read_one(*file);
        require_size(*file, **twin, width, height);
    }
    return all;
}

} // namespace shadowproof
