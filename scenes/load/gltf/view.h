// Cameras and KHR_lights_punctual lights of a file, and the defaults used where it has none.
#pragma once

#include "scenes/load/gltf/gltf.h"
#include "scenes/load/gltf/nodes.h"

namespace shadowproof::gltf {

/// The camera that the request names, else the first perspective one in the scene, else the first,
/// else the default framing (said in scene.notes): the bounding sphere just fits the picture, seen
/// from the front, right and above with a field of view of 45 degrees, near plane half way to the
/// sphere, no far plane. Throws Error: no such camera, one without extent, a degenerate transform.
Camera choose_camera(const Document& document, const NodeGraph& graph, const SceneRequest& request,
                     Scene& scene);

/// Fills scene.lights and scene.light: those in the scene, else (said in scene.notes) a point light
/// above and to the left of the camera, three radii of the bounding sphere from its centre.
/// Needs scene.camera.
void choose_light(const Document& document, const NodeGraph& graph, const SceneRequest& request,
                  Scene& scene);

} // namespace shadowproof::gltf
