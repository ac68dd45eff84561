// What a renderer with one fault would show, predicted from the exact reference: which pixels would
// be lit. The diagnosis asks which fault a picture has, controls whether it would be caught.
#pragma once

#include "compare/picture/patches.h"
#include "reference/predict/traced_scene.h"

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>

namespace shadowproof {

/// Sets the classes of the pixels in some patches; elsewhere the picture is left as it is. Before,
/// all of it holds the truth.
using Predict = std::function<void(std::span<const Patch> patches, Image<Visibility>& picture)>;

/// Each pixel that faces the light becomes what `change` makes of its truth.
Predict changed(const TracedScene& traced,
                std::function<Visibility(std::size_t pixel, Visibility truth)> change);

/// The truth of another scene of the same camera. `make` is called for each prediction, so that
/// scenes do not pile up.
Predict truth_of(std::function<Scene()> make, int threads);

/// Whether a pixel's surface faces the light, and lies in its cone.
bool faces_light(const TracedScene& traced, std::size_t pixel);
bool in_cone(const GroundTruth& truth, std::size_t pixel);
/// Both: others are dark in any case.
bool may_be_lit(const TracedScene& traced, std::size_t pixel);

/// Calls visit(x, y) for each pixel of the patches that may_be_lit, in order.
template <class Visit>
void for_each_lightable(const TracedScene& traced, std::span<const Patch> patches,
                        const Visit& visit) {
    for (const Patch& patch : patches)
        for_each_pixel(patch, [&](int x, int y) {
            if (may_be_lit(traced, traced.truth().visibility.index(x, y))) visit(x, y);
        });
}

/// The point that is seen at a pixel, in double.
glm::dvec3 seen_point(const TracedScene& traced, int x, int y);

/// The scene with only those triangles casting that `casts` names, or with only those that `keeps`
/// names. Triangles may be in another order.
Scene cast_by(const Scene& scene, const std::function<bool(std::uint32_t)>& casts);
Scene kept_by(const Scene& scene, const std::function<bool(std::uint32_t)>& keeps);

} // namespace shadowproof
