// The report's page: what index.html holds, apart from how the folder is written.
#pragma once

#include "compare/report.h"

#include <string>

namespace shadowproof {

/// index.html, failures first. No times: the same run gives the same bytes.
std::string to_html(const Report& report);

} // namespace shadowproof
