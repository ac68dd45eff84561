// Each claim of the documents about bump mapping as a section of Markdown: what is claimed, what is
// measured, and whether it holds.
#pragma once

#include <string>
#include <vector>

namespace shadowproof::claims {

struct Section {
    std::string title;
    std::string text;   ///< Markdown, the same in every run
    std::string timing; ///< Markdown, another in every run; may be empty
};

std::vector<Section> bump_claims();

} // namespace shadowproof::claims
