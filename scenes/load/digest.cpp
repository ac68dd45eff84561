#include "scenes/load/digest.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <memory>
#include <type_traits>

namespace shadowproof {

namespace {

/// XXH3 over a stream of bytes.
class Hash {
public:
    Hash() : state_(XXH3_createState()) { XXH3_64bits_reset(state_.get()); }

    template <class T>
    void add(const T* values, std::size_t count) {
        static_assert(std::is_trivially_copyable_v<T>);
        XXH3_64bits_update(state_.get(), values, count * sizeof(T));
    }
    template <class T>
    void add(const T& value) {
        add(&value, 1);
    }
    std::uint64_t digest() const { return XXH3_64bits_digest(state_.get()); }

private:
    struct FreeState {
        void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
    };
    std::unique_ptr<XXH3_state_t, FreeState> state_;
};

void add_camera(Hash& hash, const Camera& camera) {
    for (const glm::dvec3& v : {camera.eye, camera.right, camera.up, camera.forward}) hash.add(v);
    for (const double v : {camera.half_height, camera.near, camera.far}) hash.add(v);
    for (const int v : {camera.width, camera.height}) hash.add(v);
    if (camera.is_orthographic()) hash.add(camera.projection);
}

void add_light(Hash& hash, const Light& light) {
    hash.add(light.kind);
    hash.add(homogeneous(light));
    if (light.kind == Light::Kind::spot) {
        hash.add(light.direction);
        hash.add(light.outer_cone);
    }
}

void add_environment(Hash& hash, const Scene& scene) {
    for (const Image<glm::vec3>& face : *scene.environment) {
        hash.add(face.width);
        hash.add(face.pixels.data(), face.pixels.size());
    }
    for (const Material& material : scene.materials) hash.add(material.reflectance);
}

/// What affects colours but not visibility.
void add_lighting(Hash& hash, const Scene& scene) {
    hash.add(scene.surfaces.data(), scene.surfaces.size());
    for (const TextureImage& texture : scene.textures) {
        for (const int v : {texture.texels.width, texture.texels.height}) hash.add(v);
        for (const Wrap wrap : {texture.wrap_s, texture.wrap_t}) hash.add(wrap);
        hash.add(texture.texels.pixels.data(), texture.texels.pixels.size());
    }
    for (const Mesh& mesh : scene.meshes) hash.add(mesh.material);
    for (const Material& material : scene.materials) {
        for (const glm::dvec3& v : {material.color, material.specular}) hash.add(v);
        for (const std::uint32_t v : {material.decal, material.bump_map}) hash.add(v);
        hash.add(material.gloss_in_alpha);
        hash.add(material.bump);
        hash.add(material.bump_scale);
        hash.add(material.height_in_space);
    }
    const Light& light = chosen_light(scene);
    for (const glm::dvec3& v : {scene.ambient, light.color}) hash.add(v);
    for (const double v : {light.intensity, light.inner_cone}) hash.add(v);
    for (std::size_t before = 0; before + 1 < added_lights(scene); ++before) {
        const Light& other = scene.lights[before];
        add_light(hash, other);
        hash.add(other.color);
        for (const double v : {other.intensity, other.inner_cone}) hash.add(v);
    }
    hash.add(scene.inverse_square);
    hash.add(scene.highlight.shadow);
    hash.add(scene.highlight.squarings);
    if (scene.environment) add_environment(hash, scene);
}

void add_masks(Hash& hash, const Scene& scene) {
    hash.add(scene.mask_at.data(), scene.mask_at.size());
    for (const AlphaMask& mask : scene.masks) {
        for (const int v : {mask.alpha.width, mask.alpha.height}) hash.add(v);
        for (const Wrap wrap : {mask.wrap_s, mask.wrap_t}) hash.add(wrap);
        hash.add(mask.nearest);
        hash.add(mask.least);
        hash.add(mask.alpha.pixels.data(), mask.alpha.pixels.size());
    }
    const std::vector<std::uint32_t> masks = masks_of_triangles(scene);
    hash.add(masks.data(), masks.size());
}

} // namespace

std::string digest_of(const Scene& scene) {
    Hash hash;
    hash.add(scene.positions.data(), scene.positions.size());
    hash.add(scene.triangles.data(), scene.triangles.size());
    for (const std::vector<std::uint8_t>& flags :
         {double_sided_triangles(scene), casting_triangles(scene), receiving_triangles(scene)})
        hash.add(flags.data(), flags.size());
    add_camera(hash, scene.camera);
    add_light(hash, chosen_light(scene));
    if (is_bump_lit(scene)) add_lighting(hash, scene);
    if (has_masks(scene)) add_masks(hash, scene);
    return fmt::format("{:016x}", hash.digest());
}

} // namespace shadowproof
