// Finds causes by counterfactuals: a cause is a limitation that has to be lifted for the claim to
// be true. What a counter reads without a limitation: reference/predict/limitation.h.
#pragma once

#include "reference/predict/limitation.h"

#include <functional>
#include <optional>

namespace shadowproof {

/// The smallest set of a technique's limitations that makes a wrong pixel right when all of it is
/// lifted; of equally small sets, the first in the order of the causes. None if not even lifting
/// all does. `mends`: whether lifting a set leads to the truth. It is called for each limitation up
/// to the first that mends alone; if nothing mends, for all 2^n sets.
std::optional<Limitations> needed_lifts(Limitations has,
                                        const std::function<bool(Limitations)>& mends);

/// The first of a set, which must not be empty: the cause that counts.
Cause decisive_cause(Limitations needed);

} // namespace shadowproof
