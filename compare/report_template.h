// Text with named gaps, "{{name}}", filled with values: what the report's pages are made from.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace shadowproof {

/// Gaps filled as they are: values that hold markup go in unchanged, so escape the others.
using Gaps = std::map<std::string, std::string, std::less<>>;

/// A gap without a value, or a value without a gap, is a mistake in the program (asserted).
std::string fill(std::string_view text, const Gaps& values);

/// An embedded file of compare/viewer, "page.html"; one that is not there is asserted.
std::string_view viewer_file(std::string_view name);

/// All of compare/viewer's scripts, one after the other.
std::string viewer_script();

} // namespace shadowproof
