#include "tests/bench/float_tracer.h"

#include "reference/parallel.h"

#include <embree3/rtcore.h>

#include <array>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof {

struct FloatTracer::State {
    const Scene* scene = nullptr;
    int threads = 1;
    RTCDevice device = nullptr;
    RTCScene world = nullptr;
};

FloatTracer::FloatTracer(const Scene& scene, int threads) : state_(std::make_unique<State>()) {
    state_->scene = &scene;
    state_->threads = thread_count(threads);
    state_->device = rtcNewDevice(nullptr);
    state_->world = rtcNewScene(state_->device);
    rtcSetSceneFlags(state_->world, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(state_->world, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry mesh = rtcNewGeometry(state_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(glm::vec3), scene.positions.size()));
    std::copy(scene.positions.begin(), scene.positions.end(), vertices);
    auto* triangles = static_cast<glm::uvec3*>(
        rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                sizeof(glm::uvec3), scene.triangles.size()));
    std::copy(scene.triangles.begin(), scene.triangles.end(), triangles);
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(state_->world, mesh);
    rtcReleaseGeometry(mesh);
    rtcCommitScene(state_->world);
}

FloatTracer::~FloatTracer() {
    rtcReleaseScene(state_->world);
    rtcReleaseDevice(state_->device);
}

namespace {

constexpr int packet = 16;
constexpr int tile_side = 4;

void trace_tile(const Scene& scene, RTCScene world, int left, int top, Image<Visibility>& picture) {
    const Camera& camera = scene.camera;
    const glm::vec3 eye(camera.eye);
    const glm::vec3 light(chosen_light(scene).position);
    alignas(64) std::array<int, packet> valid{};
    RTCRayHit16 rays{};
    for (int i = 0; i < packet; ++i) {
        const int x = left + i % tile_side;
        const int y = top + i / tile_side;
        valid[static_cast<std::size_t>(i)] = x < camera.width && y < camera.height ? -1 : 0;
        const glm::vec3 d(line_of_sight(camera, x + 0.5, y + 0.5));
        rays.ray.org_x[i] = eye.x;
        rays.ray.org_y[i] = eye.y;
        rays.ray.org_z[i] = eye.z;
        rays.ray.dir_x[i] = d.x;
        rays.ray.dir_y[i] = d.y;
        rays.ray.dir_z[i] = d.z;
        rays.ray.tnear[i] = static_cast<float>(camera.near);
        rays.ray.tfar[i] = static_cast<float>(camera.far);
        rays.ray.mask[i] = 0xffffffffU;
        rays.ray.flags[i] = 0;
        rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid.data(), world, &context, &rays);

    alignas(64) std::array<int, packet> shadowed{};
    RTCRay16 shadow{};
    for (int i = 0; i < packet; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (valid[k] == 0 || rays.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
        const glm::vec3 d(rays.ray.dir_x[i], rays.ray.dir_y[i], rays.ray.dir_z[i]);
        const glm::vec3 n(rays.hit.Ng_x[i], rays.hit.Ng_y[i], rays.hit.Ng_z[i]);
        const glm::vec3 point = eye + rays.ray.tfar[i] * d;
        const glm::vec3 to_light = light - point;
        picture.at(left + i % tile_side, top + i / tile_side) = Visibility::shadowed;
        if (!(glm::dot(n, to_light) * glm::dot(n, d) < 0)) continue;
        shadowed[k] = -1;
        shadow.org_x[i] = point.x;
        shadow.org_y[i] = point.y;
        shadow.org_z[i] = point.z;
        shadow.dir_x[i] = to_light.x;
        shadow.dir_y[i] = to_light.y;
        shadow.dir_z[i] = to_light.z;
        shadow.tnear[i] = 1e-4F; // the usual remedy against self-shadowing
        shadow.tfar[i] = 1;
        shadow.mask[i] = 0xffffffffU;
        shadow.flags[i] = 0;
    }
    rtcOccluded16(shadowed.data(), world, &context, &shadow);
    for (int i = 0; i < packet; ++i)
        if (shadowed[static_cast<std::size_t>(i)] != 0 && shadow.tfar[i] >= 0)
            picture.at(left + i % tile_side, top + i / tile_side) = Visibility::lit;
}

} // namespace

Image<Visibility> FloatTracer::trace() const {
    const Camera& camera = state_->scene->camera;
    Image<Visibility> picture(camera.width, camera.height);
    parallel_for((camera.height + tile_side - 1) / tile_side, state_->threads, [&](int row, int) {
        for (int left = 0; left < camera.width; left += tile_side)
            trace_tile(*state_->scene, state_->world, left, row * tile_side, picture);
    });
    return picture;
}

} // namespace shadowproof
