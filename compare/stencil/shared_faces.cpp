#include "compare/stencil/shared_faces.h"

namespace shadowproof {

SharedFaces faces_of_sample(const PixelFaces& pixel, const Sample& sample) {
    SharedFaces faces;
    for (const CandidateFace& face : pixel.candidates(sample, pixel.clip_depths().front())) {
        if (face.certain && !face.nominally) continue;
        const Crossing& crossing = face.crossing;
        const FaceKey key{crossing.part, crossing.triangle, crossing.is_side() ? crossing.edge : 0,
                          crossing.change};
        const auto [same, is_new] = faces.emplace(key, face);
        if (!is_new) same->second.crossing.change += crossing.change;
    }
    return faces;
}

void merge(const SharedFaces& sample, bool is_first, SharedFaces& faces) {
    for (auto& [key, face] : faces) {
        const auto same = sample.find(key);
        face.certain = face.certain && same != sample.end() && same->second.certain;
    }
    for (const auto& [key, face] : sample) {
        const bool is_new = faces.emplace(key, face).second;
        if (is_new && !is_first) faces.at(key).certain = false;
    }
}

std::vector<PossibleFace> possible_faces(const SharedFaces& faces) {
    std::vector<PossibleFace> possible;
    for (const auto& [key, face] : faces) possible.push_back({face.crossing, face.certain});
    return possible;
}

} // namespace shadowproof
