#include "scenes/load/gltf/pose.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof::gltf {

namespace {

enum class Interpolation : std::uint8_t { step, linear, cubic };

/// Where a time falls among the key frames: between `key` and `next` (the same at the ends).
struct Moment {
    std::size_t key = 0;
    std::size_t next = 0;
    double fraction = 0; ///< 0 at key, 1 at next
    double seconds = 0;  ///< from key to next
};

Moment find_moment(const std::vector<double>& times, double time) {
    const auto after = std::upper_bound(times.begin(), times.end(), time);
    if (after == times.begin()) return {};
    const auto key = static_cast<std::size_t>(after - times.begin()) - 1;
    if (after == times.end()) return {key, key, 0, 0};
    const double seconds = times[key + 1] - times[key];
    return {key, key + 1, (time - times[key]) / seconds, seconds};
}

/// Key times, strictly increasing.
std::vector<double> read_times(AccessorReader& reader, const Place& place, int accessor) {
    std::vector<double> times = reader.read(place, accessor, TINYGLTF_TYPE_SCALAR, floats).values;
    const auto bad = std::adjacent_find(times.begin(), times.end(), std::greater_equal<>());
    if (bad != times.end())
        place.refuse(fmt::format("key frame {} is not later than the one before it",
                                 bad - times.begin() + 1),
                     "sort the key frames");
    return times;
}

Interpolation interpolation_of(const Place& place, const std::string& name) {
    if (name == "STEP") return Interpolation::step;
    if (name == "LINEAR") return Interpolation::linear;
    if (name == "CUBICSPLINE") return Interpolation::cubic;
    place.refuse(fmt::format("\"{}\" is no interpolation", name),
                 "use \"STEP\", \"LINEAR\" or \"CUBICSPLINE\"");
}

/// Spherical interpolation along the shorter arc (glTF 2.0, appendix C.4) where `spherical`, else
/// linear.
std::vector<double> mix(const double* a, const double* b, std::size_t width, double t,
                        bool spherical) {
    std::vector<double> result(width);
    if (spherical) {
        const glm::dquat q = glm::slerp(glm::normalize(glm::dquat(a[3], a[0], a[1], a[2])),
                                        glm::normalize(glm::dquat(b[3], b[0], b[1], b[2])), t);
        return {q.x, q.y, q.z, q.w};
    }
    for (std::size_t k = 0; k < width; ++k) result[k] = a[k] + t * (b[k] - a[k]);
    return result;
}

/// Appendix C.5: in-tangent, value, out-tangent for each key.
std::vector<double> spline(const double* values, std::size_t width, const Moment& moment) {
    const double t = moment.fraction;
    const double* key = values + moment.key * 3 * width;
    const double* next = values + moment.next * 3 * width;
    std::vector<double> result(width);
    for (std::size_t k = 0; k < width; ++k)
        result[k] = (2 * t * t * t - 3 * t * t + 1) * key[width + k] +
                    moment.seconds * (t * t * t - 2 * t * t + t) * key[2 * width + k] +
                    (-2 * t * t * t + 3 * t * t) * next[width + k] +
                    moment.seconds * (t * t * t - t * t) * next[k];
    return result;
}

/// The accessor type and component kinds of a path's values.
struct Values {
    int type = TINYGLTF_TYPE_VEC3;
    unsigned kinds = floats;
};

Values values_of(const Place& place, const std::string& path) {
    if (path == "translation" || path == "scale") return {};
    if (path == "rotation") return {TINYGLTF_TYPE_VEC4, floats | normalized_integers};
    if (path == "weights") return {TINYGLTF_TYPE_SCALAR, floats | normalized_integers};
    place.refuse(fmt::format("\"{}\" is no animated property", path),
                 "use \"translation\", \"rotation\", \"scale\" or \"weights\"");
}

std::vector<double> evaluate(AccessorReader& reader, const Place& place,
                             const tinygltf::AnimationSampler& sampler, const Values& wanted,
                             double time) {
    const std::vector<double> times = read_times(reader, place / "input", sampler.input);
    const Place output = place / "output";
    const Elements values = reader.read(output, sampler.output, wanted.type, wanted.kinds);
    const Interpolation interpolation =
        interpolation_of(place / "interpolation", sampler.interpolation);
    const std::size_t keys = times.size() * (interpolation == Interpolation::cubic ? 3 : 1);
    const std::size_t width = values.values.size() / keys;
    const bool is_weights = wanted.type == TINYGLTF_TYPE_SCALAR;
    if (width == 0 || values.values.size() % keys != 0 ||
        (!is_weights && width != values.components))
        output.refuse(fmt::format("has {} elements for {} key frames", values.count, times.size()),
                      "give each key frame its values");
    const Moment moment = find_moment(times, time);
    const double* first = values.values.data();
    if (interpolation == Interpolation::cubic) return spline(first, width, moment);
    const double fraction = interpolation == Interpolation::step ? 0 : moment.fraction;
    return mix(first + moment.key * width, first + moment.next * width, width, fraction,
               wanted.type == TINYGLTF_TYPE_VEC4);
}

void apply(const Place& channel, const std::string& path, const std::vector<double>& value,
           Node& node) {
    if (path == "weights") {
        node.weights = value;
        return;
    }
    if (node.matrix)
        channel.refuse("animates a node that has a matrix", "give the node translation, rotation "
                                                            "and scale");
    if (path == "translation") node.translation = {value[0], value[1], value[2]};
    if (path == "scale") node.scale = {value[0], value[1], value[2]};
    if (path == "rotation") {
        node.rotation = glm::normalize(glm::dquat(value[3], value[0], value[1], value[2]));
        if (!std::isfinite(glm::dot(node.rotation, node.rotation)))
            channel.refuse("comes to a rotation without direction", "mend its key frames");
    }
}

} // namespace

void pose_nodes(AccessorReader& reader, double time, NodeGraph& graph,
                std::vector<std::string>& notes) {
    const std::vector<tinygltf::Animation>& animations = reader.document().model.animations;
    if (animations.empty()) return;
    notes.push_back(
        animations.size() == 1
            ? fmt::format("posed at {} s of the animation", time)
            : fmt::format("posed at {} s of the first of {} animations", time, animations.size()));
    const tinygltf::Animation& animation = animations.front();
    const Place place = reader.document().root() / "animations" / 0;
    for (std::size_t i = 0; i < animation.channels.size(); ++i) {
        const tinygltf::AnimationChannel& channel = animation.channels[i];
        if (channel.target_node < 0) continue; // glTF allows it, as for an extension's property
        const Place here = place / "channels" / i;
        const Values wanted = values_of(here / "target" / "path", channel.target_path);
        const std::size_t sampler = as_index(channel.sampler);
        if (sampler >= animation.samplers.size())
            (here / "sampler")
                .refuse(fmt::format("{} is no index into the {} samplers", sampler,
                                    animation.samplers.size()),
                        "name a sampler that exists");
        const std::vector<double> value = evaluate(reader, place / "samplers" / sampler,
                                                   animation.samplers[sampler], wanted, time);
        apply(here, channel.target_path, value, graph.nodes[as_index(channel.target_node)]);
    }
}

} // namespace shadowproof::gltf
