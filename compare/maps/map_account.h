// The story of one pixel, as `explain` and the viewer tell it of a shadow map.
#pragma once

#include "compare/judge/account.h"
#include "compare/maps/map_report.h"

#include <optional>

namespace shadowproof {

/// `pixel`: what it asked, if it asked. Lengths are times `unit` (Scene::unit).
Account account_of_lookup(const std::optional<PixelLookup>& pixel, const MapModel& model,
                          double unit);

} // namespace shadowproof
