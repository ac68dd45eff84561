// Templates of the report's pages: text with named gaps, "{{name}}", to be filled with values.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace shadowproof {

/// Values of the gaps. They are inserted unchanged: escape those that are not markup.
using Gaps = std::map<std::string, std::string, std::less<>>;

/// A gap without a value, or a value without a gap, is a mistake in the program (asserted).
std::string fill(std::string_view text, const Gaps& values);

/// An embedded file of compare/viewer, "page.html"; it must exist (asserted).
std::string_view viewer_file(std::string_view name);

/// The scripts of the report's page, and its styles, one after the other.
std::string viewer_script();
std::string viewer_style();

} // namespace shadowproof
