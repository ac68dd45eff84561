// Numbers as text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace shadowproof {

/// "1,204"
std::string grouped(std::uint64_t number);

/// "1 cell", "1,204 cells"
std::string counted(std::uint64_t number, std::string_view thing);

} // namespace shadowproof
