// Faults of any size: the smallest that the judge catches, by halving.
#pragma once

#include "tests/sensitivity/trial.h"

#include <cstdint>
#include <string>
#include <vector>

namespace shadowproof {

/// Whether a fault may be of any size.
bool is_scaled(const faults::Fault& fault);

struct Limit {
    int number = 0;    ///< of the fault
    int smallest = 0;  ///< 2 to this power is caught; 0: nothing is
    TriedCell finding; ///< where
};

/// Those of the catalogue that are chosen (one number per fault, 1 or 0), nothing of them caught.
std::vector<Limit> limits_of(const std::vector<std::uint8_t>& chosen);

/// Halves each on this scene as long as it is caught with one of its techniques.
void lower(std::vector<Limit>& limits, Trial& trial);

/// "| `viewport_shift` | pixels | 2^-7 (0.0078) | `ordinary/zpass` | ... |", a row for each.
std::string table_of(const std::vector<Limit>& limits);

/// The limits that a page's table states.
std::vector<Limit> limits_of_page(const std::string& file);

} // namespace shadowproof
