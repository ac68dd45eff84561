#include "scenes/relations/relation_table.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <utility>

namespace shadowproof {

namespace {

/// Beyond that many triangles nothing is subdivided.
constexpr std::size_t most_triangles_changed = 2'000'000;

/// All numbers below a count, in an order that is always the same. Standard distributions and
/// shuffles differ from library to library.
std::vector<std::uint32_t> shuffled(std::size_t count, std::mt19937_64& random) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    return order;
}

/// Writes triangles and their surfaces down anew, with the meshes that hold them.
class Rewriter {
public:
    explicit Rewriter(const Scene& scene) : from_(scene), changed_{.scene = scene} {
        changed_.scene.triangles.clear();
        changed_.scene.surfaces.clear();
        changed_.scene.meshes.clear();
    }

    Scene& scene() { return changed_.scene; }

    void begin_mesh(const Mesh& like) {
        Mesh& mesh = changed_.scene.meshes.emplace_back(like);
        mesh.first_triangle = static_cast<std::uint32_t>(changed_.scene.triangles.size());
        mesh.triangle_count = 0;
    }

    /// The corners are those of the original, beginning with its corner `first`.
    void add(std::uint32_t original, int first = 0) {
        const glm::uvec3& t = from_.triangles[original];
        add_corners(original, {t[first], t[(first + 1) % 3], t[(first + 2) % 3]});
        if (!from_.surfaces.empty())
            for (int k = 0; k < 3; ++k)
                changed_.scene.surfaces.push_back(
                    from_.surfaces[3 * std::size_t{original} +
                                   static_cast<std::size_t>((first + k) % 3)]);
    }

    /// Of a scene without surfaces.
    void add_corners(std::uint32_t original, const glm::uvec3& corners) {
        changed_.scene.triangles.push_back(corners);
        changed_.original.push_back(original);
        ++changed_.scene.meshes.back().triangle_count;
    }

    ChangedScene take() { return std::move(changed_); }

private:
    const Scene& from_;
    ChangedScene changed_;
};

/// Vertices, triangles within their meshes, the meshes and the first corners in another order.
std::optional<ChangedScene> permute(const Scene& scene) {
    std::mt19937_64 random(1);
    Rewriter rewriter(scene);
    const std::vector<std::uint32_t> vertices = shuffled(scene.positions.size(), random);
    std::vector<std::uint32_t> new_number(vertices.size());
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        rewriter.scene().positions[i] = scene.positions[vertices[i]];
        if (has_masks(scene)) rewriter.scene().mask_at[i] = scene.mask_at[vertices[i]];
        new_number[vertices[i]] = i;
    }
    for (const std::uint32_t number : shuffled(scene.meshes.size(), random)) {
        const Mesh& mesh = scene.meshes[number];
        rewriter.begin_mesh(mesh);
        for (const std::uint32_t i : shuffled(mesh.triangle_count, random))
            rewriter.add(mesh.first_triangle + i, static_cast<int>(random() % 3));
    }
    ChangedScene changed = rewriter.take();
    for (glm::uvec3& triangle : changed.scene.triangles)
        for (int k = 0; k < 3; ++k) triangle[k] = new_number[triangle[k]];
    return changed;
}

/// Every mesh in two.
std::optional<ChangedScene> split(const Scene& scene) {
    Rewriter rewriter(scene);
    for (const Mesh& mesh : scene.meshes) {
        rewriter.begin_mesh(mesh);
        for (std::uint32_t i = 0; i < mesh.triangle_count; ++i) {
            if (i > 0 && i == mesh.triangle_count / 2) rewriter.begin_mesh(mesh);
            rewriter.add(mesh.first_triangle + i);
        }
    }
    if (rewriter.scene().meshes.size() == scene.meshes.size()) return std::nullopt;
    return rewriter.take();
}

/// Whether triangles of two meshes are seen, lit and shadowed alike.
bool are_alike(const Scene& scene, const Mesh& a, const Mesh& b) {
    const bool same_material =
        a.material == b.material ||
        (!is_bump_lit(scene) &&
         scene.materials[a.material].mask == scene.materials[b.material].mask &&
         scene.materials[a.material].double_sided == scene.materials[b.material].double_sided);
    return same_material && a.casts == b.casts && a.receives == b.receives;
}

/// Meshes that follow each other and are alike made one.
std::optional<ChangedScene> join(const Scene& scene) {
    Rewriter rewriter(scene);
    for (const Mesh& mesh : scene.meshes) {
        const std::vector<Mesh>& made = rewriter.scene().meshes;
        if (made.empty() || !are_alike(scene, made.back(), mesh)) rewriter.begin_mesh(mesh);
        for (std::uint32_t i = 0; i < mesh.triangle_count; ++i)
            rewriter.add(mesh.first_triangle + i);
    }
    if (rewriter.scene().meshes.size() == scene.meshes.size()) return std::nullopt;
    return rewriter.take();
}

/// The point between two vertices, where a float can hold it.
std::optional<glm::vec3> exact_middle(const glm::vec3& a, const glm::vec3& b) {
    const glm::dvec3 sum = glm::dvec3(a) + glm::dvec3(b);
    const glm::vec3 middle(0.5 * sum);
    // The sum of two floats that are far apart in size is rounded already.
    if (sum - glm::dvec3(a) != glm::dvec3(b) || sum - glm::dvec3(b) != glm::dvec3(a) ||
        2.0 * glm::dvec3(middle) != sum)
        return std::nullopt;
    return middle;
}

std::optional<std::array<glm::vec3, 3>> exact_middles(const Scene& scene, const glm::uvec3& t) {
    std::array<glm::vec3, 3> middles{};
    for (int k = 0; k < 3; ++k) {
        const auto middle = exact_middle(scene.positions[t[k]], scene.positions[t[(k + 1) % 3]]);
        if (!middle) return std::nullopt;
        middles[static_cast<std::size_t>(k)] = *middle;
    }
    return middles;
}

/// Four triangles for each whose edges have exact middles. Their neighbours may keep their edges:
/// the surface is the same.
std::optional<ChangedScene> subdivide(const Scene& scene) {
    // Surfaces and coordinates would have to be interpolated, which rounds.
    if (is_bump_lit(scene) || has_masks(scene) ||
        4 * scene.triangles.size() > most_triangles_changed)
        return std::nullopt;
    Rewriter rewriter(scene);
    for (const Mesh& mesh : scene.meshes) {
        rewriter.begin_mesh(mesh);
        for (std::uint32_t i = 0; i < mesh.triangle_count; ++i) {
            const std::uint32_t number = mesh.first_triangle + i;
            const glm::uvec3& t = scene.triangles[number];
            const auto middles = exact_middles(scene, t);
            if (!middles) {
                rewriter.add(number);
                continue;
            }
            std::vector<glm::vec3>& positions = rewriter.scene().positions;
            const auto first = static_cast<std::uint32_t>(positions.size());
            positions.insert(positions.end(), middles->begin(), middles->end());
            const glm::uvec3 middle(first, first + 1, first + 2);
            for (int k = 0; k < 3; ++k)
                rewriter.add_corners(number, {t[k], middle[k], middle[(k + 2) % 3]});
            rewriter.add_corners(number, middle);
        }
    }
    if (rewriter.scene().triangles.size() == scene.triangles.size()) return std::nullopt;
    return rewriter.take();
}

} // namespace

std::vector<Relation> mesh_changes() {
    return {
        {.name = "permuted",
         .words = "vertices, triangles, corners and meshes in another order",
         .change = permute},
        {.name = "split", .words = "each mesh in two", .change = split},
        {.name = "joined", .words = "meshes that are alike made one", .change = join},
        {.name = "subdivided",
         .words = "triangles cut in four where the middles of their edges are exact",
         .change = subdivide},
    };
}

} // namespace shadowproof
