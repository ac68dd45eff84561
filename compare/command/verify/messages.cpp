#include "compare/command/verify/messages.h"

#include "scenes/error.h"

#include <poll.h>
#include <unistd.h>

#include <cereal/archives/binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/variant.hpp>
#include <cereal/types/vector.hpp>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <sstream>

// Each structure is unpacked into all its members, so that a new member does not compile until it
// is sent, too. Members named in capitals are not sent: pictures, and large data that is not needed
// any more.

namespace glm {

template <class Archive>
void serialize(Archive& archive, dvec3& v) {
    archive(v.x, v.y, v.z);
}

} // namespace glm

namespace shadowproof {

template <class Archive>
void serialize(Archive& archive, DriverInfo& info) {
    auto& [version, renderer, subpixel_bits, depth_bits, stencil_bits] = info;
    archive(version, renderer, subpixel_bits, depth_bits, stencil_bits);
}

template <class Archive>
void serialize(Archive& archive, Light& light) {
    auto& [name, choice, kind, position, direction, inner_cone, outer_cone, color, intensity] =
        light;
    archive(name, choice, kind, position, direction, inner_cone, outer_cone, color, intensity);
}

template <class Archive>
void serialize(Archive& archive, Camera& camera) {
    auto& [eye, right, up, forward, tan_half_height, near, far, width, height] = camera;
    archive(eye, right, up, forward, tan_half_height, near, far, width, height);
}

template <class Archive>
void serialize(Archive& archive, Mesh& mesh) {
    auto& [name, first_triangle, triangle_count, material, casts, receives] = mesh;
    archive(name, first_triangle, triangle_count, material, casts, receives);
}

template <class Archive>
void serialize(Archive& archive, TraceStatistics& statistics) {
    auto& [milliseconds, build_milliseconds, rays, exact_decisions, lit, shadowed, background,
           degenerate] = statistics;
    archive(milliseconds, build_milliseconds, rays, exact_decisions, lit, shadowed, background,
            degenerate);
}

template <class Archive>
void serialize(Archive& archive, GroundTruth& truth) {
    auto& [VISIBILITY, TRIANGLE, DEPTH, EXACTNESS, IN_CONE, statistics] = truth;
    archive(statistics);
}

template <class Archive>
void serialize(Archive& archive, FirstDifference& first) {
    auto& [x, y, cause] = first;
    archive(x, y, cause);
}

template <class Archive>
void serialize(Archive& archive, EvidenceCheck& check) {
    auto& [equal, in_band, unexplained, first_x, first_y] = check;
    archive(equal, in_band, unexplained, first_x, first_y);
}

template <class Archive>
void serialize(Archive& archive, ColorModel& model) {
    auto& [arithmetic, axes, normalisation, bump_form, reflects] = model;
    archive(arithmetic, axes, normalisation, bump_form, reflects);
}

template <class Archive>
void serialize(Archive& archive, BoundWidth& bound_width) {
    auto& [median, percentile999, widest] = bound_width;
    archive(median, percentile999, widest);
}

template <class Archive>
void serialize(Archive& archive, ColorCheck& check) {
    auto& [model, ERROR, VERDICT, judged, largest, largest_x, largest_y, rmse, percentile999,
           beyond, unpredicted, moved, interpolated, bound_width, beyond_by, first_unpredicted_x,
           first_unpredicted_y] = check;
    archive(model, judged, largest, largest_x, largest_y, rmse, percentile999, beyond, unpredicted,
            moved, interpolated, bound_width, beyond_by, first_unpredicted_x, first_unpredicted_y);
}

template <class Archive>
void serialize(Archive& archive, EvidenceSummary& summary) {
    auto& [unexplained, results, words, pictures] = summary;
    archive(unexplained, results, words, pictures);
}

template <class Archive>
void serialize(Archive& archive, Comparison& comparison) {
    auto& [CAUSE, ALSO, several, EVIDENCE_MISS, causes, differing, first, evidence_name, evidence,
           summary, colors] = comparison;
    archive(several, causes, differing, first, evidence_name, evidence, summary, colors);
}

template <class Archive>
void serialize(Archive& archive, PixelChange& change) {
    auto& [x, y, cause, was] = change;
    archive(x, y, cause, was);
}

template <class Archive>
void serialize(Archive& archive, Since& since) {
    auto& [appeared, gone, changed, causes, first_new, first_gone, first_changed] = since;
    archive(appeared, gone, changed, causes, first_new, first_gone, first_changed);
}

template <class Archive>
void serialize(Archive& archive, Cell& cell) {
    auto& [technique, family, summary, command, error, verdict, milliseconds, left_out, excused,
           since, first_failing, comparison, cause_map, FRAME, EVIDENCE] = cell;
    archive(technique, family, summary, command, error, verdict, milliseconds, left_out, excused,
            since, first_failing, comparison, cause_map);
}

template <class Archive>
void serialize(Archive& archive, SceneResult& scene) {
    auto& [name, file, argument, width, height, triangles, digest, light, one_of_many, camera, far,
           meshes, provokes, left_out, notes, no_longer_provoked, error, truth, bump_lit, COLOR,
           cells] = scene;
    archive(name, file, argument, width, height, triangles, digest, light, one_of_many, camera, far,
            meshes, provokes, left_out, notes, no_longer_provoked, error, truth, bump_lit, cells);
}

namespace messages {

template <class Archive>
void serialize(Archive& archive, Begun& begun) {
    auto& [gl, embree] = begun;
    archive(gl, embree);
}

template <class Archive>
void serialize(Archive& archive, SceneBegun& begun) {
    archive(begun.scene);
}

template <class Archive>
void serialize(Archive& archive, SceneRead& read) {
    auto& [lights, none_suits] = read;
    archive(lights, none_suits);
}

template <class Archive>
void serialize(Archive& archive, SceneTraced& traced) {
    archive(traced.scene);
}

template <class Archive>
void serialize(Archive& archive, SceneFailed& failed) {
    auto& [name, error] = failed;
    archive(name, error);
}

template <class Archive>
void serialize(Archive& archive, CellBegun& begun) {
    auto& [technique, summary] = begun;
    archive(technique, summary);
}

template <class Archive>
void serialize(Archive& archive, CellDone& done) {
    auto& [cell, report_milliseconds] = done;
    archive(cell, report_milliseconds);
}

template <class Archive>
void serialize(Archive& /*archive*/, SceneDone& /*done*/) {}

template <class Archive>
void serialize(Archive& archive, RunFailed& failed) {
    archive(failed.error);
}

template <class Archive>
void serialize(Archive& /*archive*/, Done& /*done*/) {}

} // namespace messages

namespace {

/// Each message is preceded by the number of its bytes.
using Length = std::uint64_t;

void write_whole(int pipe, const std::string& bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
        const ssize_t written = write(pipe, bytes.data() + at, bytes.size() - at);
        if (written < 0 && errno != EINTR)
            throw Error("shadowproof", "the process that watches over this one is gone",
                        "run it again");
        if (written > 0) at += static_cast<std::size_t>(written);
    }
}

} // namespace

void send(int pipe, const Message& message) {
    std::ostringstream stream;
    {
        cereal::BinaryOutputArchive archive(stream);
        archive(message);
    }
    const std::string body = stream.str();
    const Length length = body.size();
    std::string bytes(sizeof length, '\0');
    std::memcpy(bytes.data(), &length, sizeof length);
    write_whole(pipe, bytes + body);
}

bool MessageReader::holds_message() const {
    Length length = 0;
    if (bytes_.size() < sizeof length) return false;
    std::memcpy(&length, bytes_.data(), sizeof length);
    return bytes_.size() - sizeof length >= length;
}

void MessageReader::read_some(int milliseconds) {
    pollfd waiting{.fd = pipe_, .events = POLLIN, .revents = 0};
    if (poll(&waiting, 1, milliseconds) <= 0) return;
    constexpr std::size_t most = std::size_t{1} << 16;
    const std::size_t held = bytes_.size();
    bytes_.resize(held + most);
    const ssize_t got = read(pipe_, bytes_.data() + held, most);
    bytes_.resize(held + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    ended_ = got == 0 || (got < 0 && errno != EINTR);
}

std::optional<Message> MessageReader::next(int milliseconds) {
    if (!holds_message() && !ended_) read_some(milliseconds);
    if (!holds_message()) return std::nullopt;
    Length length = 0;
    std::memcpy(&length, bytes_.data(), sizeof length);
    std::istringstream stream(bytes_.substr(sizeof length, length));
    bytes_.erase(0, sizeof length + length);
    cereal::BinaryInputArchive archive(stream);
    Message message;
    archive(message);
    return message;
}

} // namespace shadowproof
