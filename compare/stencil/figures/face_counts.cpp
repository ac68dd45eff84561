#include "compare/stencil/figures/face_counts.h"

#include "compare/driver/nearness.h"
#include "reference/parallel.h"

#include <algorithm>

namespace shadowproof {

namespace {

/// Faces prepared at a time: a few megabytes of them.
constexpr std::size_t batch_size = 4096;

/// Rows that one thread fills: a part of the picture of its own.
constexpr int band_height = 16;

/// Adds up the faces of one row after the other.
class Rows {
public:
    Rows(const DrawnPicture& picture, const Image<double>* depths, FaceCounts& counts)
        : frame_(picture.frame), depths_(depths), counts_(counts),
          width_(picture.casters.camera.width), height_(picture.casters.camera.height),
          fragments_(static_cast<std::size_t>(height_)),
          roundings_(window_roundings(frame_.depth_model)),
          furthest_(furthest_nearness(frame_.depth_model)) {}

    int bands() const { return (height_ + band_height - 1) / band_height; }

    /// The rows in which a face may have fragments.
    PixelRun rows_of(const PicturedFace& face) const {
        const PixelRun own = face.possible.rows(height_);
        if (!face.stands_for_both || !face.is_one_of_two) return own;
        return either(own, face.certain_of_both.rows(height_));
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
    WindowRoundings roundings_;
    double furthest_; ///< to which faces are clamped

    static PixelRun common(const PixelRun& one, const PixelRun& other) {
        return {std::max(one.first, other.first), std::min(one.end, other.end)};
    }

    void count_fragments(const PicturedFace& face, int y, const PixelRun& possible,
                         const PixelRun& certain) {
        FigureRange& row = fragments_[static_cast<std::size_t>(y)];
        const int counted = face.stands_for_both ? certain.length() : 0;
        const int others = possible.length() - common(certain, possible).length();
        row.low += std::uint64_t{face.copies} * static_cast<std::uint64_t>(counted);
        row.high +=
            std::uint64_t{face.copies} * face.times * static_cast<std::uint64_t>(counted + others);
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
            const auto most = static_cast<std::int32_t>(face.copies * face.times);
            for (int x = possible.first; x < possible.end; ++x) high[x] += most;
            for (int x = certain.first; face.in_front && x < certain.end; ++x) low[x] += copies;
            return;
        }
        if (face.parts.size() == 1) {
            const double error = roundings_.constant + face.parts.front().error;
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

    /// Counts the face where it is not behind what is seen, with its nearness moved by `side`
    /// times its error; a light cap at least once where its own triangle is seen.
    template <class ErrorAt>
    void add_in_front(const PicturedFace& face, int y, PixelRun run, double side,
                      const ErrorAt& error_at, std::int32_t* faces) const {
        const double* seen = &depths_->at(0, y);
        const std::uint32_t* triangles = &frame_.triangle.at(0, y);
        const glm::dvec3& inverse = face.nearness;
        const double start = inverse.z + inverse.y * (y + 0.5) + inverse.x * 0.5;
        const double slope = inverse.x;
        const double share = roundings_.share;
        const std::uint32_t own = face.light_cap_of;
        const std::uint32_t own_count = face.own_triangles;
        const auto copies = static_cast<std::int32_t>(face.copies);
        for (int x = run.first; x < run.end; ++x) {
            const double depth = start + slope * x;
            const double moved = depth + side * (error_at(x) + share * depth);
            const bool in_front = std::max(moved, furthest_) >= seen[x];
            const std::int32_t seen_itself = triangles[x] - own < own_count ? 1 : 0;
            faces[x] += in_front ? copies : seen_itself;
        }
    }

    /// The largest of all parts that may cover a pixel.
    void set_errors(const PicturedFace& face, int y, PixelRun run, std::vector<double>& errors) {
        std::fill(errors.begin() + run.first, errors.begin() + run.end, roundings_.constant);
        for (const DepthError& part : face.parts) {
            const PixelRun covered = part.part.row(y, width_);
            const double error = part.error + roundings_.constant;
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
    const PicturedFaces pictured(picture);
    Rows rows(picture, depths, counts);
    for (std::size_t first = 0; first < pictured.count(); first += batch_size) {
        std::vector<PicturedFace> faces(std::min(batch_size, pictured.count() - first));
        std::vector<PixelRun> runs(faces.size());
        parallel_for_all(
            faces.size(), threads,
            [&](std::size_t i) {
                faces[i] = pictured.face(first + i);
                runs[i] = rows.rows_of(faces[i]);
            },
            64);
        parallel_for(rows.bands(), threads, [&](int band, int) { rows.add(faces, runs, band); });
    }
    counts.fragments = rows.fragments();
    return counts;
}

} // namespace

FaceCounts count_faces(const DrawnPicture& picture, int threads) {
    const Image<double> depths = nearness_read_back(picture.frame);
    return counted(picture, &depths, threads);
}

FigureRange count_fragments(const DrawnPicture& picture, int threads) {
    return counted(picture, nullptr, threads).fragments;
}

} // namespace shadowproof
