// The report's page: the viewer of compare/viewer in one file. It holds no results, so that it is
// the same for every run of one version of the program.
#pragma once

#include <string>

namespace shadowproof {

/// index.html.
std::string report_page();

} // namespace shadowproof
