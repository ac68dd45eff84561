// Shadow maps: pictures of the casters as the light sees them. How a technique draws and looks up
// its map, from which the map is predicted, and what was read back. Also THE definition of which
// camera draws which face.
#pragma once

#include "scenes/camera.h"
#include "scenes/cube_map.h"
#include "scenes/depth_model.h"
#include "scenes/image.h"
#include "scenes/scene.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>
#include <vector>

namespace shadowproof {

/// What a map's texels hold.
enum class MapValue : std::uint8_t {
    distance, ///< from the light, over `far`; made by the fragment shader
    depth,    ///< window depth of the light's camera
};

/// In which format they are stored.
enum class MapFormat : std::uint8_t {
    d16,
    d24,
    d32f,
    /// A byte of a colour: which of 256 equal steps from the near to the far plane the depth lies
    /// in. The depth that is compared is taken from the same steps.
    ramp8,
};

/// Which sides of the casters are not drawn into the map.
enum class MapCulling : std::uint8_t {
    none,
    front, ///< those that face the light when wound counter-clockwise
    back,
};

/// What is averaged over a block of texels.
enum class MapAverage : std::uint8_t {
    comparisons, ///< percentage-closer filtering: the claim is the share of texels that say `lit`
    values,      ///< what the texels hold, which is compared once
};

/// What a block of texels holds that reaches beyond a face of a cube.
enum class MapEdges : std::uint8_t {
    clamped,  ///< the face's outermost texels, repeated
    seamless, ///< those of the adjacent face
};

inline constexpr std::array all_map_values{MapValue::distance, MapValue::depth};
/// Those that the user may choose: `ramp8` is a technique of its own.
inline constexpr std::array all_map_formats{MapFormat::d16, MapFormat::d24, MapFormat::d32f};
inline constexpr std::array all_map_cullings{MapCulling::none, MapCulling::front, MapCulling::back};
inline constexpr std::array all_map_averages{MapAverage::comparisons, MapAverage::values};
inline constexpr std::array all_map_edges{MapEdges::clamped, MapEdges::seamless};

/// Texels along a side of the largest block that is averaged. The shader adds the number of texels
/// that say `lit` to a byte that holds `shadowed`, and more would not fit.
inline constexpr int largest_map_filter = 13;

/// The largest slope bias and the most units: what they move a surface by is far beyond any scene.
inline constexpr double largest_polygon_offset = 1e6;

constexpr std::string_view name_of(MapValue value) {
    return value == MapValue::distance ? "distance" : "depth";
}

constexpr std::string_view name_of(MapFormat format) {
    switch (format) {
    case MapFormat::d16:
        return "d16";
    case MapFormat::d24:
        return "d24";
    case MapFormat::ramp8:
        return "ramp8";
    case MapFormat::d32f:
        break;
    }
    return "d32f";
}

constexpr std::string_view name_of(MapCulling culling) {
    switch (culling) {
    case MapCulling::none:
        return "none";
    case MapCulling::front:
        return "front";
    case MapCulling::back:
        break;
    }
    return "back";
}

constexpr std::string_view name_of(MapAverage average) {
    return average == MapAverage::comparisons ? "comparisons" : "values";
}

constexpr std::string_view name_of(MapEdges edges) {
    return edges == MapEdges::clamped ? "clamped" : "seamless";
}

constexpr DepthFormat depth_format_of(MapFormat format) {
    switch (format) {
    case MapFormat::d16:
        return {16, false};
    case MapFormat::d24:
        return {24, false};
    case MapFormat::ramp8:
        return {8, false};
    case MapFormat::d32f:
        break;
    }
    return {32, true};
}

/// What the user asked for; where nothing is set, each technique uses its own.
struct MapSettings {
    std::optional<int> size{};    ///< texels a side
    std::optional<double> bias{}; ///< in the file's units of length
    std::optional<double> slope_bias{};
    std::optional<double> offset_units{};
    std::optional<MapValue> value{};
    std::optional<MapFormat> format{};
    std::optional<MapCulling> culling{};
    std::optional<double> near{}; ///< in the file's units of length
    std::optional<double> far{};  ///< in the file's units of length
    std::optional<int> filter{};  ///< texels a side of the block
    std::optional<MapAverage> average{};
    std::optional<MapEdges> edges{};
};

/// How a map is made and asked. The claim is `shadowed` where value + bias < what the receiver's
/// own point has, both in world units: its distance from the light, or its depth from it.
struct MapModel {
    enum class Shape : std::uint8_t {
        cube, ///< six faces around the light
        spot, ///< one square, which holds the cone
        sun,  ///< one square in parallel projection, which holds all that casts or receives
    };
    Shape shape = Shape::cube;
    int size = 1024; ///< texels a side
    double bias = 0; ///< world units
    /// OpenGL's polygon offset, its factor: by how many times its own window depth's change over a
    /// texel's step a surface is moved away as it is drawn. 0 where distances are stored, which are
    /// no window depths.
    double slope_bias = 0;
    /// The same, its units: by how many times what the depth format resolves.
    double offset_units = 0;
    MapValue value = MapValue::distance;
    MapFormat format = MapFormat::d32f;
    MapCulling culling = MapCulling::none;
    double near = 0; ///< of the light's camera, world units
    double far = 1;
    glm::dvec3 eye{0, 0, 0}; ///< of a sun: the middle of its square, where depths begin
    double half_side = 1;    ///< of a sun's square, world units
    /// Texels a side of the block that is averaged, around the point's place in the map; beside a
    /// map that is no cube its border is repeated. 0: the texel at that place alone.
    int filter = 0;
    MapAverage average = MapAverage::comparisons;
    MapEdges edges = MapEdges::clamped;

    std::size_t faces() const { return shape == Shape::cube ? 6 : 1; }
    bool has_offset() const { return slope_bias != 0 || offset_units != 0; }
    bool is_ramp() const { return format == MapFormat::ramp8; }
    /// How many texels are read for one point.
    int asked() const { return filter > 0 ? filter * filter : 1; }
};

/// How much of window depth one unit of a polygon offset is: from `least` to `most`. Of floats it
/// is what they resolve next to a triangle's largest depth, and both are 0.
struct OffsetUnit {
    double least = 0;
    double most = 0;
};

/// The evidence of a claim made by a shadow map.
struct MapEvidence {
    MapModel model;
    /// As read back, one per face, in OpenGL's order for a cube; rows from the top of the picture
    /// that the face's camera takes.
    std::vector<Image<float>> faces;
    DepthFormat format{};        ///< of the texture, as the driver names it
    OffsetUnit offset_unit{};    ///< of the driver, where the model asks for units
    double map_milliseconds = 0; ///< drawing the maps of all lights, in a frame that waited for it
};

/// The values of the source documents where the user asked for nothing: the bias is 0.15 world
/// units (omni-directional shadows, 2nd pass). They leave the planes open: `far` is the light's
/// range, or where it has none a little beyond the farthest caster's corner, and `near` 2^-10 of
/// that, 2^-14 where distances are stored. A sun's depths begin a little before all that casts or
/// receives, and end a little behind; it stores depths whatever the user asked, as nothing has a
/// distance from it. The light must have a position, but for a sun's map. Throws Error where the
/// user's planes are no range, a spot is too wide, or distances shall have a polygon offset.
MapModel with_settings(MapModel model, const MapSettings& settings, const Scene& scene);

/// Fits a sun's square and planes to all that casts or receives. A margin around them is far more
/// than floats move anything, so that nothing is clipped; what has no extent has a map all the
/// same.
void fit_sun(MapModel& model, const Scene& scene);

/// The camera that draws a face: at the light, square. For a cube it looks along an axis, and its
/// rows and columns are those of OpenGL's face, from the last row up (cube_map.h). For a spot it
/// looks along the light's axis and holds the whole cone. For a sun it is orthographic, and looks
/// along the light.
Camera map_camera(const Light& light, const MapModel& model, std::size_t face);

/// Where a point, relative to the eye of a face's camera, lies in its picture: in texels from the
/// top left corner. In perspective its depth must be above 0.
glm::dvec2 place_in_map(const MapModel& model, const Camera& camera, const glm::dvec3& from_eye);

/// How the face's window depths are made, which clipping follows even where distances are stored.
/// Perspective alone.
DepthModel map_depth_model(const MapModel& model);

/// The window depth of a depth of the light's camera: 0 at the near plane, 1 at the far.
double map_window_depth(const MapModel& model, double depth);

/// How many steps a ramp has; its texels hold step / (steps - 1).
inline constexpr int ramp_steps = 256;

/// Where a depth lies on a ramp, from 0 at the near plane to 1 at the far, and beyond.
double place_on_ramp(const MapModel& model, double depth);

/// The step of a place on the ramp, from 0; beyond the planes the first and the last.
int ramp_step(double place);

/// What a stored value stands for: a distance or a depth, world units; of a ramp the middle of its
/// step.
double value_of_stored(const MapModel& model, double stored);

/// Whether a spot's cone is narrow enough for one map, 1.5 radians to each side; true for
/// other lights.
bool fits_one_map(const Light& light);

/// Half the side of a spot's map at depth 1; the outer cone must be narrower than a half space.
double half_side_of_spot(const Light& light);

} // namespace shadowproof
