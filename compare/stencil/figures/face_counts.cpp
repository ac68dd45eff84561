#include "compare/stencil/figures/face_counts.h"

#include "compare/judge/surface_check.h"
#include "compare/stencil/figures/near_layers.h"
#include "compare/stencil/figures/pictured_face.h"
#include "reference/parallel.h"
#include "scenes/driver.h"
#include "scenes/mesh/touching_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Faces prepared at a time: a few megabytes of them.
constexpr std::size_t batch_size = 4096;

/// Rows that one thread fills: a part of the picture of its own.
constexpr int band_height = 16;

PictureMaking making_of(const DrawnPicture& picture) {
    const Frame& frame = picture.frame;
    const bool clips = frame.depth_model.clips_at_far();
    return {picture.casters.camera,
            drawing_of(picture.casters, frame.depth_model, clips ? picture.far : infinity),
            half_snapping_step(frame.depth_model.subpixel_bits)};
}

/// Prepares the faces by their number: those of volumes, then the layers.
class Pictured {
public:
    explicit Pictured(const DrawnPicture& picture)
        : picture_(picture), making_(making_of(picture)),
          light_(homogeneous(chosen_light(picture.casters))),
          light_in_near_plane_(is_in_near_plane(picture.casters)),
          casters_touch_light_(!picture.faces.near_layers.empty() &&
                               !triangles_touching_light(picture.casters).empty()) {}

    std::size_t count() const {
        return picture_.faces.faces.size() + picture_.faces.near_layers.size();
    }
    PicturedFace face(std::size_t number) const {
        const std::vector<DrawnFace>& faces = picture_.faces.faces;
        return number < faces.size() ? volume_face(faces[number])
                                     : layer(picture_.faces.near_layers[number - faces.size()]);
    }

private:
    const DrawnPicture& picture_;
    PictureMaking making_;
    glm::dvec4 light_;
    bool light_in_near_plane_;
    bool casters_touch_light_;

    glm::dvec4 place(std::uint32_t corner) const {
        const std::vector<glm::vec3>& positions = picture_.casters.positions;
        if (corner < positions.size()) return {glm::dvec3(positions[corner]), 1};
        const std::size_t end = corner - positions.size();
        if (end >= positions.size())
            return at_infinity(picture_.faces.far_points[end - positions.size()]);
        if (picture_.far_ends != nullptr) return {glm::dvec3((*picture_.far_ends)[end]), 1};
        return at_infinity(positions[end]);
    }
    glm::dvec4 at_infinity(const glm::dvec3& point) const {
        return {light_.w * point - glm::dvec3(light_), 0};
    }

    PicturedFace volume_face(const DrawnFace& drawn) const {
        const glm::dvec4 other = drawn.other_corner ? place(*drawn.other_corner) : glm::dvec4(0);
        PicturedFace face = pictured_face(
            making_, {place(drawn.corners.x), place(drawn.corners.y), place(drawn.corners.z)},
            drawn.other_corner ? &other : nullptr, glm::length(glm::dvec3(light_)));
        face.stands_for_both = !drawn.other_corner || drawn.first_of_side;
        face.copies = drawn.copies;
        if (drawn.part == DrawnFace::Part::light_cap) {
            face.light_cap_of = drawn.triangle;
            face.own_triangles = drawn.copies;
        }
        if (!drawn.certain) face.certain = face.certain_of_both = {};
        return face;
    }

    /// The place of a layer is not predicted for a light in the near plane, nor for a caster that
    /// touches the light: there the counter, which is judged at every pixel, begins with what was
    /// drawn.
    PicturedFace layer(const NearLayer& layer) const {
        const NearDrawing drawn{picture_.frame.counted->volume_faces.near_plane,
                                casters_touch_light_};
        const bool is_capped = drawn.near_plane == NearPlane::capped;
        if (light_in_near_plane_ || layer.touches_light ||
            (is_capped && is_flat_from_light(picture_.casters, layer.triangle)))
            return pictured_anywhere();
        const auto left = [&](PlaneCut cut) {
            return near_layer(picture_.casters, layer.triangle, drawn, cut);
        };
        return pictured_layer(making_, left(PlaneCut::most), left(PlaneCut::least));
    }

    static PicturedFace pictured_anywhere() {
        PicturedFace face;
        face.possible = ConvexRegion::everywhere();
        face.in_front = true;
        return face;
    }
};

/// Change of window depth with inverse view depth, taken between infinity and the near plane: over
/// far smaller steps it would be lost to rounding.
double slope_of_window_depth(const DepthModel& model) {
    return (window_depth(model, 1 / model.near) - window_depth(model, 0)) * model.near;
}

/// The inverse view depths, read back, that a face must reach in order not to be behind what is
/// seen. A background is behind everything.
Image<double> inverse_depths(const Frame& frame) {
    const double at_infinity = window_depth(frame.depth_model, 0);
    const double slope = slope_of_window_depth(frame.depth_model);
    Image<double> inverse(frame.depth.width, frame.depth.height);
    for (std::size_t i = 0; i < inverse.pixels.size(); ++i)
        inverse.pixels[i] = frame.triangle.pixels[i] == no_triangle
                                ? -infinity
                                : (double{frame.depth.pixels[i]} - at_infinity) / slope;
    return inverse;
}

/// Adds up the faces of one row after the other.
class Rows {
public:
    Rows(const DrawnPicture& picture, const Image<double>* depths, FaceCounts& counts)
        : frame_(picture.frame), depths_(depths), counts_(counts),
          width_(picture.casters.camera.width), height_(picture.casters.camera.height),
          fragments_(static_cast<std::size_t>(height_)),
          constant_error_(frame_.depth_model.reversed()
                              ? 0
                              : window_depth_roundings * v /
                                    std::abs(slope_of_window_depth(frame_.depth_model))),
          share_error_(frame_.depth_model.reversed() ? window_depth_roundings * v : 0) {}

    int bands() const { return (height_ + band_height - 1) / band_height; }

    /// The rows in which a face may have fragments.
    PixelRun rows_of(const PicturedFace& face) const {
        const PixelRun own = face.possible.rows(height_);
        if (!face.stands_for_both || !face.is_one_of_two) return own;
        const PixelRun both = face.certain_of_both.rows(height_);
        if (both.length() == 0) return own;
        if (own.length() == 0) return both;
        return {std::min(own.first, both.first), std::max(own.end, both.end)};
    }

    /// `rows`: those of each face.
    void add(const std::vector<PicturedFace>& faces, const std::vector<PixelRun>& rows, int band) {
        std::vector<double> errors(static_cast<std::size_t>(width_));
        for (std::size_t i = 0; i < faces.size(); ++i) {
            const int first = std::max(rows[i].first, band * band_height);
            const int end = std::min(rows[i].end, (band + 1) * band_height);
            for (int y = first; y < end; ++y) add_row(faces[i], y, errors);
        }
    }

    FigureRange fragments() const {
        FigureRange all;
        for (const FigureRange& row : fragments_) {
            all.low += row.low;
            all.high += row.high;
        }
        return all;
    }

private:
    const Frame& frame_;
    const Image<double>* depths_;
    FaceCounts& counts_;
    int width_;
    int height_;
    std::vector<FigureRange> fragments_; ///< of each row
    // Errors of any inverse depth, from the window's roundings: see error_bounds.h.
    double constant_error_;
    double share_error_; ///< of its size

    static PixelRun common(const PixelRun& one, const PixelRun& other) {
        return {std::max(one.first, other.first), std::min(one.end, other.end)};
    }

    void count_fragments(const PicturedFace& face, int y, const PixelRun& possible,
                         const PixelRun& certain) {
        FigureRange& row = fragments_[static_cast<std::size_t>(y)];
        const int counted = face.stands_for_both ? certain.length() : 0;
        const int others = possible.length() - common(certain, possible).length();
        row.low += std::uint64_t{face.copies} * static_cast<std::uint64_t>(counted);
        row.high += std::uint64_t{face.copies} * static_cast<std::uint64_t>(counted + others);
    }

    void add_row(const PicturedFace& face, int y, std::vector<double>& errors) {
        const PixelRun possible = face.possible.row(y, width_);
        const PixelRun covered = face.certain.row(y, width_);
        count_fragments(face, y, possible,
                        face.is_one_of_two ? face.certain_of_both.row(y, width_) : covered);
        if (depths_ == nullptr || possible.length() == 0) return;
        const PixelRun certain = common(covered, possible);
        std::int32_t* low = &counts_.low.at(0, y);
        std::int32_t* high = &counts_.high.at(0, y);
        if (face.in_front || face.edge_on) {
            const auto copies = static_cast<std::int32_t>(face.copies);
            for (int x = possible.first; x < possible.end; ++x) high[x] += copies;
            for (int x = certain.first; face.in_front && x < certain.end; ++x) low[x] += copies;
            return;
        }
        if (face.parts.size() == 1) {
            const double error = constant_error_ + face.parts.front().error;
            add_in_front(
                face, y, possible, 1, [=](int) { return error; }, high);
            add_in_front(
                face, y, certain, -1, [=](int) { return error; }, low);
            return;
        }
        set_errors(face, y, possible, errors);
        const double* own = errors.data();
        add_in_front(
            face, y, possible, 1, [=](int x) { return own[x]; }, high);
        add_in_front(
            face, y, certain, -1, [=](int x) { return own[x]; }, low);
    }

    /// Counts the face where it is not behind what is seen, with its inverse depth moved by `side`
    /// times its error; a light cap at least once where its own triangle is seen.
    template <class ErrorAt>
    void add_in_front(const PicturedFace& face, int y, PixelRun run, double side,
                      const ErrorAt& error_at, std::int32_t* faces) const {
        const double* seen = &depths_->at(0, y);
        const std::uint32_t* triangles = &frame_.triangle.at(0, y);
        const glm::dvec3& inverse = face.inverse_depth;
        const double start = inverse.z + inverse.y * (y + 0.5) + inverse.x * 0.5;
        const double slope = inverse.x;
        const double share = share_error_;
        const std::uint32_t own = face.light_cap_of;
        const std::uint32_t own_count = face.own_triangles;
        const auto copies = static_cast<std::int32_t>(face.copies);
        for (int x = run.first; x < run.end; ++x) {
            const double depth = start + slope * x;
            const bool in_front = depth + side * (error_at(x) + share * depth) >= seen[x];
            const std::int32_t seen_itself = triangles[x] - own < own_count ? 1 : 0;
            faces[x] += in_front ? copies : seen_itself;
        }
    }

    /// The largest of all parts that may cover a pixel.
    void set_errors(const PicturedFace& face, int y, PixelRun run, std::vector<double>& errors) {
        std::fill(errors.begin() + run.first, errors.begin() + run.end, constant_error_);
        for (const DepthError& part : face.parts) {
            const PixelRun covered = part.part.row(y, width_);
            const double error = part.error + constant_error_;
            for (int x = std::max(covered.first, run.first); x < std::min(covered.end, run.end);
                 ++x) {
                double& largest = errors[static_cast<std::size_t>(x)];
                largest = std::max(largest, error);
            }
        }
    }
};

FaceCounts counted(const DrawnPicture& picture, const Image<double>* depths, int threads) {
    const Camera& camera = picture.casters.camera;
    FaceCounts counts;
    if (depths != nullptr) {
        counts.low = Image<std::int32_t>(camera.width, camera.height);
        counts.high = Image<std::int32_t>(camera.width, camera.height);
    }
    const Pictured pictured(picture);
    Rows rows(picture, depths, counts);
    for (std::size_t first = 0; first < pictured.count(); first += batch_size) {
        std::vector<PicturedFace> faces(std::min(batch_size, pictured.count() - first));
        std::vector<PixelRun> runs(faces.size());
        constexpr std::size_t together = 64;
        const auto pieces = static_cast<int>((faces.size() + together - 1) / together);
        parallel_for(pieces, threads, [&](int piece, int) {
            const std::size_t begin = static_cast<std::size_t>(piece) * together;
            for (std::size_t i = begin; i < std::min(begin + together, faces.size()); ++i) {
                faces[i] = pictured.face(first + i);
                runs[i] = rows.rows_of(faces[i]);
            }
        });
        parallel_for(rows.bands(), threads, [&](int band, int) { rows.add(faces, runs, band); });
    }
    counts.fragments = rows.fragments();
    return counts;
}

} // namespace

FaceCounts count_faces(const DrawnPicture& picture, int threads) {
    const Image<double> depths = inverse_depths(picture.frame);
    return counted(picture, &depths, threads);
}

FigureRange count_fragments(const DrawnPicture& picture, int threads) {
    return counted(picture, nullptr, threads).fragments;
}

} // namespace shadowproof
