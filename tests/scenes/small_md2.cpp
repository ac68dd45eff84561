#include "tests/scenes/small_md2.h"

namespace shadowproof::test {

namespace {

void put_text(FileBytes& bytes, const std::string& text, std::size_t length) {
    for (std::size_t i = 0; i < length; ++i)
        bytes.push_back(i < text.size() ? static_cast<std::uint8_t>(text[i]) : 0);
}

void put_frame(FileBytes& bytes, const Md2Frame& frame) {
    for (int k = 0; k < 3; ++k) put(bytes, frame.scale[k]);
    for (int k = 0; k < 3; ++k) put(bytes, frame.translation[k]);
    put_text(bytes, frame.name, 16);
    for (const std::array<std::uint8_t, 3>& vertex : frame.vertices) {
        for (const std::uint8_t coordinate : vertex) put(bytes, coordinate);
        put(bytes, std::uint8_t{255}); // no index of any table of normals
    }
}

} // namespace

FileBytes bytes_of(const Md2& model) {
    constexpr std::size_t header_bytes = 68;
    const std::size_t vertices = model.frames.empty() ? 0 : model.frames[0].vertices.size();
    const std::size_t skins = model.skin.empty() ? 0 : 1;
    const std::size_t places_at = header_bytes + 64 * skins;
    const std::size_t triangles_at = places_at + 4 * model.places.size();
    const std::size_t frames_at = triangles_at + 12 * model.triangles.size();
    const std::size_t frame_bytes = 40 + 4 * vertices;
    const std::size_t end = frames_at + frame_bytes * model.frames.size();
    FileBytes bytes;
    put_text(bytes, "IDP2", 4);
    for (const std::size_t number :
         {std::size_t{8}, static_cast<std::size_t>(model.size.x),
          static_cast<std::size_t>(model.size.y), frame_bytes, skins, vertices, model.places.size(),
          model.triangles.size(), std::size_t{0}, model.frames.size(), header_bytes, places_at,
          triangles_at, frames_at, end, end})
        put(bytes, static_cast<std::uint32_t>(number));
    if (skins > 0) put_text(bytes, model.skin, 64);
    for (const auto& place : model.places)
        for (const std::int16_t texel : place) put(bytes, texel);
    for (const auto& triangle : model.triangles)
        for (const std::uint16_t index : triangle) put(bytes, index);
    for (const Md2Frame& frame : model.frames) put_frame(bytes, frame);
    return bytes;
}

Md2 tetrahedron() {
    Md2 model;
    model.places = {{0, 31}, {63, 31}, {0, 0}, {63, 0}};
    // 0 the origin, 1, 2, 3 along x, y, z; clockwise from outside.
    model.triangles = {
        {0, 1, 2, 0, 1, 2}, {0, 2, 3, 0, 2, 3}, {0, 3, 1, 0, 3, 1}, {1, 3, 2, 1, 3, 2}};
    const glm::vec3 step(0.5F, 0.25F, 0.125F);
    const glm::vec3 from(-1, -2, -3);
    model.frames = {{"run1", step, from, {{2, 8, 24}, {22, 8, 24}, {2, 48, 24}, {2, 8, 104}}},
                    {"run2", step, from, {{2, 8, 24}, {62, 8, 24}, {2, 48, 24}, {2, 8, 184}}}};
    return model;
}

} // namespace shadowproof::test
