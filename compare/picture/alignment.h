// Whether a picture shows the scene from the scene's own camera: before any pixel is judged, its
// outlines are compared with the truth's.
#pragma once

#include "reference/predict/traced_scene.h"
#include "scenes/load/picture/picture.h"

#include <cstdint>
#include <optional>
#include <string>

namespace shadowproof {

/// Twins show no shadows: what faces the light is lit, or nothing is.
enum class Shows : std::uint8_t { shadows, no_shadows };

/// How the picture's view differs from the scene's, in words; nothing where it does not: "is
/// mirrored left to right", "is shifted by half a pixel to the right", "has a field of view of 47.3
/// degrees, the scene's is 45; its camera is turned by 2.1 degrees about its up axis". The picture
/// has the size of the scene's camera.
///
/// Each surface, lit or shadowed, has its typical colour in the picture. Where another view would
/// show another surface at a pixel, the pixel votes for the one whose colour is nearer to its own;
/// another view is taken where the votes for it are more than those against, and by more than noise
/// would have them. Wrong shadows are no votes, unless they are most of what lies at outlines. A
/// view that differs is then fitted by turning the camera and by its field of view.
std::optional<std::string> misalignment(const TracedScene& traced, const Picture& picture,
                                        Shows shows);

} // namespace shadowproof
