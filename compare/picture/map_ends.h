// Where the shadow map of a spot or a directional light ends, read off a picture: there its shadows
// are cut off, or all is in shadow.
#pragma once

#include "compare/picture/light_sampling.h"
#include "compare/picture/trial.h"

#include <optional>

namespace shadowproof {

/// The box that explains most wrong pixels by lying outside of it, whether they are falsely lit or
/// falsely shadowed there. An end must explain what the others do not: a twentieth of all wrong
/// pixels, and more than the tips of shadows, which lie outermost and are wrong by any texel.
/// `high.z` is the far plane; shadows do not tell the near one. Nothing where no end explains that.
std::optional<LightFrustum> fitted_frustum(const Trial& trial);

} // namespace shadowproof
