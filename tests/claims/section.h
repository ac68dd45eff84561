// A claim of the documents as a section of Markdown: what is claimed, what is measured, and whether
// it holds.
#pragma once

#include <string>

namespace shadowproof::claims {

struct Section {
    std::string title;
    std::string text;   ///< Markdown, the same in every run
    std::string timing; ///< Markdown, another in every run; may be empty
};

} // namespace shadowproof::claims
