#include "raster/traced/embree_world.h"

#include "raster/traced/float_mask.h"
#include "scenes/error.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <type_traits>

namespace shadowproof {

namespace {

struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using World = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

/// One flag per triangle.
struct Tables {
    std::vector<std::uint8_t> seen;
    std::vector<std::uint8_t> casts;
    std::vector<std::uint32_t> masks; ///< masks_of_triangles
};

/// A context that a query's filter finds again.
struct Query : RTCIntersectContext {
    const Scene* scene = nullptr;
    const Tables* tables = nullptr;
    const std::vector<std::uint8_t>* meets = nullptr; ///< of Tables
    FloatRays* rays = nullptr;
    bool notes_hits = false; ///< shadow rays report no triangle but through the filter
};

/// Whether a hit lies in a hole of the triangle's mask.
bool is_left_out(const Query& query, const RTCFilterFunctionNArguments* args, unsigned int i,
                 unsigned int triangle) {
    const std::vector<std::uint32_t>& masks = query.tables->masks;
    if (masks.empty() || masks[triangle] == no_mask) return false;
    return !stands_at(*query.scene, masks[triangle], triangle,
                      {RTCHitN_u(args->hit, args->N, i), RTCHitN_v(args->hit, args->N, i)});
}

/// Rejects what a ray passes through; of those accepted, notes the first.
void filter(const RTCFilterFunctionNArguments* args) {
    const auto& query = *static_cast<const Query*>(args->context);
    for (unsigned int i = 0; i < args->N; ++i) {
        if (args->valid[i] == 0) continue;
        const unsigned int triangle = RTCHitN_primID(args->hit, args->N, i);
        const std::size_t lane = RTCRayN_id(args->ray, args->N, i);
        if ((*query.meets)[triangle] == 0 || query.rays->own[lane] == triangle ||
            is_left_out(query, args, i, triangle))
            args->valid[i] = 0;
        else if (query.notes_hits && query.rays->hit[lane] == no_triangle)
            query.rays->hit[lane] = triangle;
    }
}

Tables tables_of(const Scene& scene) {
    Tables tables{double_sided_triangles(scene), casting_triangles(scene),
                  masks_of_triangles(scene)};
    const glm::dvec4 eye = homogeneous_eye(scene.camera);
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        const double of_eye = side(scene, i, eye);
        tables.seen[i] = of_eye > 0 || (of_eye < 0 && tables.seen[i] != 0) ? 1 : 0;
    }
    return tables;
}

void add_triangles(RTCDevice device, RTCScene world, const Scene& scene) {
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(glm::vec3), scene.positions.size()));
    auto* triangles = static_cast<glm::uvec3*>(
        rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                sizeof(glm::uvec3), scene.triangles.size()));
    if (vertices != nullptr && triangles != nullptr) {
        std::copy(scene.positions.begin(), scene.positions.end(), vertices);
        std::copy(scene.triangles.begin(), scene.triangles.end(), triangles);
        rtcSetGeometryIntersectFilterFunction(mesh, filter);
        rtcSetGeometryOccludedFilterFunction(mesh, filter);
        rtcCommitGeometry(mesh);
        rtcAttachGeometry(world, mesh);
    }
    rtcReleaseGeometry(mesh);
}

/// Embree's answers differ by instruction set (from AVX2 on it fuses products with sums), and it
/// takes the best that the processor has: another machine would claim something else. So it is
/// given the one that every x86-64 has, unless a test chooses another.
constexpr const char* instruction_set = "sse2";

constexpr const char* tests_variable = "SHADOWPROOF_TEST_TRACED_INSTRUCTION_SET";

std::string settings_of_device() {
    std::string settings = "threads=1";
#ifdef __x86_64__ // elsewhere Embree has a single one
    const char* const chosen = std::getenv(tests_variable);
    const std::string name = chosen == nullptr || *chosen == '\0' ? instruction_set : chosen;
    constexpr std::array known{"sse2", "sse4.2", "avx", "avx2", "avx512"};
    if (std::find(known.begin(), known.end(), name) == known.end())
        throw Error(tests_variable, "\"" + name + "\" is not known",
                    "give sse2, sse4.2, avx, avx2 or avx512, or unset it");
    settings += ",isa=" + name;
#endif
    return settings;
}

/// Copies of the rays in Embree's layout. With few lanes in an instruction set, Embree divides the
/// packet and looks at all of its rays: those that are not asked for point nowhere, and end before
/// they begin.
void copy_rays(const FloatRays& rays, RTCRay16& to, std::array<int, traced_packet>& valid) {
    for (std::size_t i = 0; i < traced_packet; ++i) {
        const bool asked = rays.valid[i];
        valid[i] = asked ? -1 : 0;
        to.org_x[i] = asked ? rays.origin_x[i] : 0;
        to.org_y[i] = asked ? rays.origin_y[i] : 0;
        to.org_z[i] = asked ? rays.origin_z[i] : 0;
        to.dir_x[i] = asked ? rays.direction_x[i] : 0;
        to.dir_y[i] = asked ? rays.direction_y[i] : 0;
        to.dir_z[i] = asked ? rays.direction_z[i] : 1;
        to.tnear[i] = asked ? rays.near[i] : 0;
        to.tfar[i] = asked ? rays.far[i] : -1;
        to.time[i] = 0;
        to.mask[i] = 0xffffffffU;
        to.id[i] = static_cast<unsigned int>(i);
        to.flags[i] = 0;
    }
}

} // namespace

struct EmbreeWorld::State {
    const Scene& scene;
    Tables tables;
    Device device;
    World world;

    Query query(const std::vector<std::uint8_t>& meets, FloatRays& rays, bool notes_hits) const {
        Query query;
        rtcInitIntersectContext(&query);
        query.scene = &scene;
        query.tables = &tables;
        query.meets = &meets;
        query.rays = &rays;
        query.notes_hits = notes_hits;
        return query;
    }
    void require_success() const {
        const RTCError error = rtcGetDeviceError(device.get());
        if (error == RTC_ERROR_NONE) return;
        throw Error("Embree", "failed with its error " + std::to_string(error),
                    error == RTC_ERROR_OUT_OF_MEMORY ? "try a smaller scene"
                                                     : "leave the traced techniques out");
    }
};

EmbreeWorld::EmbreeWorld(const Scene& scene)
    : state_(new State{scene, tables_of(scene), Device(rtcNewDevice(settings_of_device().c_str())),
                       nullptr}) {
    if (!state_->device)
        throw Error("Embree", "cannot be started", "leave the traced techniques out");
    state_->world = World(rtcNewScene(state_->device.get()));
    add_triangles(state_->device.get(), state_->world.get(), scene);
    rtcCommitScene(state_->world.get());
    state_->require_success();
}

EmbreeWorld::~EmbreeWorld() = default;

void EmbreeWorld::find_nearest(FloatRays& rays) const {
    alignas(64) std::array<int, traced_packet> valid{};
    RTCRayHit16 traced;
    copy_rays(rays, traced.ray, valid);
    std::fill_n(traced.hit.geomID, traced_packet, RTC_INVALID_GEOMETRY_ID);
    rays.own.fill(no_triangle);
    Query query = state_->query(state_->tables.seen, rays, false);
    rtcIntersect16(valid.data(), state_->world.get(), &query, &traced);
    for (std::size_t i = 0; i < traced_packet; ++i) {
        const bool hit = rays.valid[i] && traced.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
        rays.hit[i] = hit ? traced.hit.primID[i] : no_triangle;
        if (rays.valid[i]) rays.far[i] = traced.ray.tfar[i];
    }
}

// A shadow ray that was stopped has a tfar of minus infinity; which triangle stopped it is known to
// the filter alone.
void EmbreeWorld::find_any(FloatRays& rays) const {
    alignas(64) std::array<int, traced_packet> valid{};
    RTCRay16 traced;
    copy_rays(rays, traced, valid);
    rays.hit.fill(no_triangle);
    Query query = state_->query(state_->tables.casts, rays, true);
    rtcOccluded16(valid.data(), state_->world.get(), &query, &traced);
    for (std::size_t i = 0; i < traced_packet; ++i)
        if (rays.valid[i] && !(traced.tfar[i] < 0)) rays.hit[i] = no_triangle;
}

} // namespace shadowproof
