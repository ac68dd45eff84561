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
    for (const std::vector<std::uint8_t>& flags :
         {double_sided_triangles(scene), casting_triangles(scene), receiving_triangles(scene)})
        add(flags.data(), flags.size());
    const Camera& camera = scene.camera;
    for (const glm::dvec3* v : {&camera.eye, &camera.right, &camera.up, &camera.forward}) add(v, 1);
    for (const double* v : {&camera.tan_half_height, &camera.near, &camera.far}) add(v, 1);
    for (const int* v : {&camera.width, &camera.height}) add(v, 1);
    const Light& light = chosen_light(scene);
    add(&light.kind, 1);
    const glm::dvec4 place = homogeneous(light);
    add(&place, 1);
    if (light.kind == Light::Kind::spot) {
        add(&light.direction, 1);
        add(&light.outer_cone, 1);
    }
    return fmt::format("{:016x}", XXH3_64bits_digest(state.get()));
}

} // namespace shadowproof
