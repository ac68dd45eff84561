#include "scenes/load/admission.h"

#include "scenes/error.h"
#include "scenes/scaling.h"
#include "scenes/surface/texel_sides.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <vector>

namespace shadowproof {

namespace {

/// The largest component's size; NaN where a component is.
template <class Vector>
double size_of(const Vector& v) {
    double size = 0;
    for (int k = 0; k < 3; ++k) {
        const double each = std::abs(static_cast<double>(v[k]));
        if (!(each <= size)) size = each;
        if (std::isnan(each)) break;
    }
    return size;
}

/// Zero where all vertices lie in the origin.
double median_size(const Scene& scene) {
    std::vector<double> sizes;
    for (const glm::vec3& position : scene.positions)
        if (const double size = size_of(position); size > 0) sizes.push_back(size);
    if (sizes.empty()) return 0;
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    return *middle;
}

class Gate {
public:
    explicit Gate(const Scene& scene) : scene_(scene) {
        const double size = median_size(scene);
        // Too small, and yet not brought to ordinary size: something would be beyond the limit.
        if (size > 0 && size < 1 / ordinary_size)
            limit_ = std::ldexp(largest_coordinate, std::ilogb(size));
    }

    void check() const {
        check_positions();
        check_camera();
        for (const Light& light : scene_.lights) check_light(light);
        check_spread();
        if (is_bump_lit(scene_)) check_lighting();
    }

private:
    const Scene& scene_;
    double limit_ = largest_coordinate;

    [[noreturn]] void refuse(const std::string& what, const std::string& remedy) const {
        throw Error(scene_.file.empty() ? scene_.name : scene_.file.string(), what, remedy);
    }

    /// In the file's own units.
    std::string words_of(const glm::dvec3& place) const {
        const glm::dvec3 at = place * scene_.unit;
        return fmt::format("({:.9g}, {:.9g}, {:.9g})", at.x, at.y, at.z);
    }

    /// The name of a camera or of a light, where it has one.
    static std::string named(const char* kind, const std::string& name) {
        return name.empty() ? fmt::format("the {}", kind)
                            : fmt::format("the {} \"{}\"", kind, name);
    }

    void check_place(const std::string& what, const glm::dvec3& place) const {
        if (size_of(place) <= limit_) return;
        refuse(fmt::format("{} is at {}, which is not within {:.3g} of the origin", what,
                           words_of(place), limit_ * scene_.unit),
               "move it nearer, or scale the scene");
    }

    void check_smallest(const std::string& what, const char* where,
                        const glm::dvec3& vector) const {
        for (int k = 0; k < 3; ++k)
            if (vector[k] != 0 && std::abs(vector[k]) < smallest_number)
                refuse(fmt::format("{} {} ({}, {}, {}), and products of a number below {:.3g} are "
                                   "lost in doubles",
                                   what, where, vector.x, vector.y, vector.z, smallest_number),
                       "write 0 for it");
    }

    void check_axis(const std::string& what, const glm::dvec3& axis) const {
        if (std::isfinite(size_of(axis)) && size_of(axis) > 0) return;
        refuse(fmt::format("{} points along ({}, {}, {})", what, axis.x, axis.y, axis.z),
               "mend its node's transform");
    }

    /// Calls visit(mesh, triangle within it, corner, place) for each corner of a triangle.
    template <class Visit>
    void each_corner(const Visit& visit) const {
        for (const Mesh& mesh : scene_.meshes)
            for (std::uint32_t i = 0; i < mesh.triangle_count; ++i)
                for (int k = 0; k < 3; ++k)
                    visit(mesh, i, k, corner(scene_, mesh.first_triangle + i, k));
    }

    std::string name_of(const Mesh& mesh, std::uint32_t triangle, int k) const {
        const std::uint32_t vertex = scene_.triangles[mesh.first_triangle + triangle][k];
        return fmt::format("mesh \"{}\": vertex {} (corner {} of triangle {})", mesh.name,
                           vertex - first_vertex(mesh), k, triangle);
    }

    void check_positions() const {
        each_corner([&](const Mesh& mesh, std::uint32_t triangle, int k, const glm::dvec3& place) {
            if (!(size_of(place) <= limit_)) check_place(name_of(mesh, triangle, k), place);
        });
    }

    /// Once all is finite.
    void check_spread() const {
        std::vector<double> distances;
        distances.reserve(3 * scene_.triangles.size());
        each_corner([&](const Mesh&, std::uint32_t, int, const glm::dvec3& place) {
            distances.push_back(size_of(place - scene_.camera.eye));
        });
        if (distances.empty()) return;
        const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
        std::nth_element(distances.begin(), middle, distances.end());
        const double furthest = largest_spread * *middle;
        const double nearest = smallest_share * *middle;
        if (furthest == 0) return;
        each_corner([&](const Mesh& mesh, std::uint32_t triangle, int k, const glm::dvec3& place) {
            const double distance = size_of(place - scene_.camera.eye);
            if (distance > furthest)
                refuse(fmt::format("{} is at {}, more than {:.3g} times as far from the camera as "
                                   "half of all corners",
                                   name_of(mesh, triangle, k), words_of(place), largest_spread),
                       "move it nearer");
            if (!scene_.camera.is_orthographic() && distance > 0 && distance < nearest)
                refuse(fmt::format("{} is at {}, nearer to the camera than {:.3g} of the distance "
                                   "of half of all corners",
                                   name_of(mesh, triangle, k), words_of(place), smallest_share),
                       "move it away, or leave out what is so far away");
        });
    }

    std::uint32_t first_vertex(const Mesh& mesh) const {
        std::uint32_t first = std::numeric_limits<std::uint32_t>::max();
        for (std::uint32_t i = 0; i < mesh.triangle_count; ++i)
            for (int k = 0; k < 3; ++k)
                first = std::min(first, scene_.triangles[mesh.first_triangle + i][k]);
        return first;
    }

    void check_camera() const {
        const Camera& camera = scene_.camera;
        check_place("the camera", camera.eye);
        check_smallest("the camera", "is at", camera.eye);
        for (const glm::dvec3& axis : {camera.right, camera.up, camera.forward})
            check_axis("the camera", axis);
        // As floats hold them; depths between the planes then are floats, too.
        const double least = camera.is_orthographic() ? 0 : std::numeric_limits<float>::min();
        if (!(camera.near >= least && camera.near <= largest_coordinate))
            refuse(fmt::format("the camera's near plane is at {:.9g}, which is not between {:.3g} "
                               "and {:.3g}",
                               camera.near * scene_.unit, least * scene_.unit,
                               largest_coordinate * scene_.unit),
                   "move the near plane");
        if (std::isfinite(camera.far) && !(camera.far <= std::numeric_limits<float>::max()))
            refuse(fmt::format("the camera's far plane is at {:.9g}, further than {:.3g}",
                               camera.far * scene_.unit,
                               std::numeric_limits<float>::max() * scene_.unit),
                   "move the far plane nearer, or leave it out");
        const glm::dvec2 half = half_extent(camera);
        if (camera.is_orthographic()) {
            check_extent(half);
            return;
        }
        if (!(std::isfinite(half.x) && std::isfinite(half.y)))
            refuse(fmt::format("the camera's picture is {:.3g} by {:.3g} at depth 1", 2 * half.x,
                               2 * half.y),
                   "use another field of view");
        if (!(std::min(half.x, half.y) >= smallest_half_extent))
            refuse(fmt::format("the camera's picture is {:.3g} by {:.3g} at depth 1, and floats "
                               "place nothing in one that is narrower than {:.3g}",
                               2 * half.x, 2 * half.y, 2 * smallest_half_extent),
                   "use a wider field of view");
    }

    /// Of an orthographic camera's picture.
    void check_extent(const glm::dvec2& half) const {
        const double least = std::numeric_limits<float>::min();
        if (std::min(half.x, half.y) >= least && std::max(half.x, half.y) <= largest_coordinate)
            return;
        refuse(fmt::format("the camera's picture is {:.3g} by {:.3g}, and its sides are not "
                           "between {:.3g} and {:.3g}",
                           2 * half.x * scene_.unit, 2 * half.y * scene_.unit,
                           2 * least * scene_.unit, 2 * largest_coordinate * scene_.unit),
               "use another xmag and ymag, or --ortho");
    }

    /// Colours, and the heights and scales of bumps: floats hold products of four of them, and the
    /// squares of slopes.
    void check_number(const std::string& what, double number) const {
        if (std::abs(number) <= largest_lighting_number) return;
        refuse(fmt::format("{} of {:.9g} is larger than {:.3g}, and lighting would leave the range "
                           "of floats",
                           what, number, largest_lighting_number),
               "write a smaller number");
    }
    void check_number(const std::string& what, const glm::dvec3& numbers) const {
        for (int k = 0; k < 3; ++k) check_number(what, numbers[k]);
    }

    /// Of heights in units of space: over the shortest way across a texel of each triangle.
    void check_slopes() const {
        for (const Mesh& mesh : scene_.meshes) {
            const Material& material = scene_.materials[mesh.material];
            if (!material.height_in_space) continue;
            for (std::uint32_t i = 0; i < mesh.triangle_count; ++i) {
                const TexelSides sides = texel_sides(scene_, mesh.first_triangle + i);
                const double area = glm::length(glm::cross(sides.along, sides.down));
                const double longer = std::max(glm::length(sides.along), glm::length(sides.down));
                if (!(area > 0)) continue;
                check_number(fmt::format("material \"{}\": on triangle {} of {} a slope of heights",
                                         material.name, i, named("mesh", mesh.name)),
                             material.bump_scale * longer / area);
            }
        }
    }

    void check_lighting() const {
        check_number("an ambient light", scene_.ambient);
        for (const Material& material : scene_.materials) {
            const std::string of = fmt::format("material \"{}\": a ", material.name);
            check_number(of + "colour", material.color);
            check_number(of + "specular colour", material.specular);
            check_number(of + "reflectance", material.reflectance);
            check_number(of + "scale of bumps", material.height_in_space
                                                    ? material.bump_scale * scene_.unit
                                                    : material.bump_scale);
        }
        check_slopes();
        for (const Light& light : scene_.lights) {
            check_number(named("light", light.name) + ": a colour", light.color);
            if (scene_.inverse_square)
                check_number(named("light", light.name) + ": an intensity",
                             light.intensity * scene_.unit * scene_.unit);
        }
    }

    void check_light(const Light& light) const {
        const std::string what = named("light", light.name);
        if (light.kind != Light::Kind::directional) {
            check_place(what, light.position);
            check_smallest(what, "is at", light.position);
        }
        if (light.kind != Light::Kind::point) {
            check_axis(what, light.direction);
            check_smallest(what, "points along", light.direction);
        }
    }
};

} // namespace

void bring_to_ordinary_size(Scene& scene) {
    const double size = median_size(scene);
    if (!(size > 0) || !std::isfinite(size)) return;
    if (size <= ordinary_size && size >= 1 / ordinary_size) return;
    const int power = -std::ilogb(size);
    if (!scales_exactly(scene, power)) return;
    scale(scene, std::ldexp(1.0, power));
    scene.notes.push_back(fmt::format(
        "worked on with all lengths times 2^{}, exactly: floats do not hold products of the file's "
        "own; explain and EXR tell lengths as in the file, the report's page as worked with",
        power));
}

Scene in_file_units(Scene scene) {
    if (scene.unit != 1) scale(scene, scene.unit);
    return scene;
}

void admit(Scene& scene) {
    bring_to_ordinary_size(scene);
    Gate(scene).check();
}

} // namespace shadowproof
