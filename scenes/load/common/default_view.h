// The camera and the light of a scene whose file has none. Needs the scene's positions. Says in
// scene.notes what was chosen, and sets scene.default_framing.
#pragma once

#include "scenes/load/common/scene_request.h"
#include "scenes/scene.h"

namespace shadowproof {

/// The bounding sphere just fits the picture, seen from the front, right and above with a field of
/// view of 45 degrees, near plane half way to the sphere, no far plane. Throws Error where all
/// vertices lie at one point.
Camera default_camera(const SceneRequest& request, Scene& scene);

/// A point light above and to the left of the camera, three radii of the bounding sphere from its
/// centre; in a room (room.h), half way from its middle to the ceiling. Needs scene.camera.
void add_default_light(Scene& scene);

/// Sets right, up and forward from a view direction and some up direction; false where they are
/// parallel, zero or not finite.
bool orient(Camera& camera, const glm::dvec3& forward, const glm::dvec3& up);

} // namespace shadowproof
