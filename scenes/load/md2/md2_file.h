// Parses a Quake II model file (.md2): every count, offset and index is checked before it is used.
// Little-endian, as published with the game's source (id Software, qfiles.h, 2001).
#pragma once

#include "scenes/memory_budget.h"

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace shadowproof::md2 {

struct Corner {
    std::uint32_t vertex = 0;
    std::uint32_t place = 0; ///< index into Model::places
};

struct Triangle {
    Corner corners[3]; ///< clockwise from the front, as the file has it
};

/// A key frame: all vertices, z up, x ahead, y to the left, in the model's units.
struct Frame {
    std::string name; ///< "run1"; what is not printable ASCII in the file is a ?
    std::vector<glm::dvec3> positions;
};

/// What a file holds, except OpenGL commands and normals (an index of each vertex into a table),
/// which are not read.
struct Model {
    std::string file;                ///< as given, for messages
    std::string skin;                ///< the first skin's name, as Frame::name; empty: no skin
    glm::ivec2 size{0, 0};           ///< of skins, texels, at least 1 each way
    std::vector<glm::ivec2> places;  ///< in a skin, texels from its upper left corner
    std::vector<Triangle> triangles; ///< at least one; all indices are in range
    std::uint32_t vertex_count = 0;
    std::uint32_t frame_count = 0;    ///< at least one
    std::uint32_t frame_bytes = 0;    ///< each
    std::vector<unsigned char> bytes; ///< of all frames
};

/// Throws Error naming the file, the thing and the remedy. What is kept of the file is counted in
/// the account.
Model read_model(const std::filesystem::path& file, MemoryAccount& memory);

/// Throws Error where a position is not finite.
Frame read_frame(const Model& model, std::uint32_t frame);

} // namespace shadowproof::md2
