#include "scenes/gltf_pose.h"

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
std::vector<double> read_times(AccessorReader& reader, const Item& input) {
    std::vector<double> times = reader.read(input, {"SCALAR"}, floats).values;
    const auto bad = std::adjacent_find(times.begin(), times.end(), std::greater_equal<>());
    if (bad != times.end())
        input.refuse(fmt::format("key frame {} is not later than the one before it",
                                 bad - times.begin() + 1),
                     "sort the key frames");
    return times;
}

Interpolation interpolation_of(const Item& sampler) {
    const std::string name = sampler.text_or("interpolation", "LINEAR");
    if (name == "STEP") return Interpolation::step;
    if (name == "LINEAR") return Interpolation::linear;
    if (name == "CUBICSPLINE") return Interpolation::cubic;
    sampler.at("interpolation")
        .refuse(fmt::format("\"{}\" is no interpolation", name),
                "use \"STEP\", \"LINEAR\" or \"CUBICSPLINE\"");
}

/// Spherical where `spherical`, the short way round (glTF 2.0, appendix C.4).
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

/// What a channel drives, and the numbers it takes for it.
struct Target {
    std::size_t node = 0;
    std::string path;
    std::string_view type;
    unsigned kinds = floats;
};

std::vector<double> evaluate(AccessorReader& reader, const Item& sampler, const Target& target,
                             double time) {
    const std::vector<double> times = read_times(reader, sampler.at("input"));
    const Item output = sampler.at("output");
    const Elements values = reader.read(output, {target.type}, target.kinds);
    const Interpolation interpolation = interpolation_of(sampler);
    const std::size_t keys = times.size() * (interpolation == Interpolation::cubic ? 3 : 1);
    const std::size_t width = values.values.size() / keys;
    const bool is_weights = target.type == "SCALAR";
    if (width == 0 || values.values.size() % keys != 0 ||
        (!is_weights && width != values.components))
        output.refuse(fmt::format("has {} elements for {} key frames", values.count, times.size()),
                      "give each key frame its values");
    const Moment moment = find_moment(times, time);
    const double* first = values.values.data();
    if (interpolation == Interpolation::cubic) return spline(first, width, moment);
    const double fraction = interpolation == Interpolation::step ? 0 : moment.fraction;
    return mix(first + moment.key * width, first + moment.next * width, width, fraction,
               target.path == "rotation");
}

void apply(const Item& channel, const Target& target, const std::vector<double>& value,
           Node& node) {
    if (target.path == "weights") {
        node.weights = value;
        return;
    }
    if (node.matrix)
        channel.refuse("animates a node that has a matrix", "give the node translation, rotation "
                                                            "and scale");
    if (target.path == "translation") node.translation = {value[0], value[1], value[2]};
    if (target.path == "scale") node.scale = {value[0], value[1], value[2]};
    if (target.path == "rotation") {
        node.rotation = glm::normalize(glm::dquat(value[3], value[0], value[1], value[2]));
        if (!std::isfinite(glm::dot(node.rotation, node.rotation)))
            channel.refuse("comes to a rotation without direction", "mend its key frames");
    }
}

/// Nothing where the channel drives no node, which glTF allows, or an extension's property.
std::optional<Target> read_target(const Item& root, const Item& channel) {
    const Item item = channel.at("target");
    const auto node = item.find("node");
    if (!node) return std::nullopt;
    Target target{reference_index(root, "nodes", *node), item.at("path").text(), "VEC3", floats};
    if (target.path == "translation" || target.path == "scale") return target;
    target.kinds = floats | normalized_integers;
    target.type = target.path == "rotation" ? "VEC4" : "SCALAR";
    if (target.path == "rotation" || target.path == "weights") return target;
    item.at("path").refuse(fmt::format("\"{}\" is no animated property", target.path),
                           "use \"translation\", \"rotation\", \"scale\" or \"weights\"");
}

} // namespace

void pose_nodes(AccessorReader& reader, double time, NodeGraph& graph,
                std::vector<std::string>& notes) {
    const Item root = reader.document().root();
    const std::size_t count = count_of(root, "animations");
    if (count == 0) return;
    const Item animation = root.at("animations")[0];
    notes.push_back(count == 1
                        ? fmt::format("posed at {} s of the animation", time)
                        : fmt::format("posed at {} s of the first of {} animations", time, count));
    const Item samplers = animation.at("samplers");
    const Item channels = animation.at("channels");
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const Item channel = channels[i];
        const auto target = read_target(root, channel);
        if (!target) continue;
        const Item reference = channel.at("sampler");
        const std::size_t sampler = reference.whole(0, 0xffffffffU);
        if (sampler >= samplers.size())
            reference.refuse(
                fmt::format("{} is no index into the {} samplers", sampler, samplers.size()),
                "name a sampler that exists");
        apply(channel, *target, evaluate(reader, samplers[sampler], *target, time),
              graph.nodes[target->node]);
    }
}

} // namespace shadowproof::gltf
