// The page of what the judge catches: written from outcomes, and held to what it says.
#pragma once

#include "tests/sensitivity/limits.h"
#include "tests/sensitivity/trial.h"

#include <string>
#include <vector>

namespace shadowproof {

/// `outcomes`: one per fault of the catalogue.
std::string page_of(const std::vector<Outcome>& outcomes, const std::vector<Limit>& limits);

/// Whether each fault of the page is caught where it says, and no fault of it is gone; and each
/// limit as small as it says, and no larger than what is aimed at. Prints what is not.
bool holds(const std::string& file);

} // namespace shadowproof
