// Techniques that are two: one finds shadows, the other lights bumps where there are none.
#pragma once

#include "raster/technique.h"

#include <string>

namespace shadowproof {

/// Lights as one technique where the other finds no shadow, and fails at what either fails at.
/// Holds the words of its technique.
class Joined {
public:
    /// `cost`: of both together, 0 where it is not measured.
    Joined(const Technique& lighting, const Technique& shadowing, double cost = 0);
    Joined(const Joined&) = delete;
    Joined& operator=(const Joined&) = delete;

    const Technique& technique() const { return technique_; }

private:
    std::string name_;
    std::string summary_;
    std::string source_;
    std::string needs_;
    Technique technique_;
};

} // namespace shadowproof
