// The page of what the judge catches: written from outcomes, and held to what it says.
#pragma once

#include "tests/sensitivity/limits.h"
#include "tests/sensitivity/trial.h"

#include <string>
#include <vector>

namespace shadowproof {

/// `outcomes`: one per fault of the catalogue.
std::string page_of(const std::vector<Outcome>& outcomes, const std::vector<Limit>& limits);

/// Faults without effect take a trial on every scene: they are proved in so many parts.
constexpr int idle_parts = 10;

/// Whether each fault of the catalogue has its row on the page: is caught where it says, or changes
/// something and escapes where it says, for a reason that the catalogue gives too, or has such a
/// reason why it changes nothing, which is tried for one of idle_parts; and each limit is as small
/// as it says, and no larger than what is aimed at. Prints what is not.
bool holds(const std::string& file, int part);

} // namespace shadowproof
