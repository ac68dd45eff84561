#include "scenes/digest.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <memory>
#include <type_traits>

namespace shadowproof {

namespace {

struct FreeState {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
};

} // namespace

std::string digest_of(const Scene& scene) {
    const std::unique_ptr<XXH3_state_t, FreeState> state(XXH3_createState());
    XXH3_64bits_reset(state.get());
    const auto add = [&](const auto* values, std::size_t count) {
        static_assert(std::is_trivially_copyable_v<std::remove_pointer_t<decltype(values)>>);
        XXH3_64bits_update(state.get(), values, count * sizeof(*values));
    };
    add(scene.positions.data(), scene.positions.size());
    add(scene.triangles.data(), scene.triangles.size());
    const std::vector<std::uint8_t> sides = double_sided_triangles(scene);
    add(sides.data(), sides.size());
    const Camera& camera = scene.camera;
    for (const glm::dvec3* v : {&camera.eye, &camera.right, &camera.up, &camera.forward}) add(v, 1);
    for (const double* v : {&camera.tan_half_height, &camera.near, &camera.far}) add(v, 1);
    for (const int* v : {&camera.width, &camera.height}) add(v, 1);
    const Light& light = chosen_light(scene);
    add(&light.kind, 1);
    add(light.kind == Light::Kind::directional ? &light.direction : &light.position, 1);
    return fmt::format("{:016x}", XXH3_64bits_digest(state.get()));
}

} // namespace shadowproof
