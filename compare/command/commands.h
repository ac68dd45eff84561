// The subcommands. Each function adds one to the command line and returns its work, which runs
// after parsing and gives the exit code.
#pragma once

#include "compare/command/options.h"

namespace shadowproof {

Work add_verify(CLI::App& app);      ///< verify.cpp
Work add_check(CLI::App& app);       ///< check/check.cpp
Work add_bench(CLI::App& app);       ///< bench/bench.cpp
Work add_stress(CLI::App& app);      ///< stress/stress.cpp
Work add_render(CLI::App& app);      ///< render.cpp
Work add_explain(CLI::App& app);     ///< explain.cpp
Work add_accept(CLI::App& app);      ///< accept.cpp
Work add_export_view(CLI::App& app); ///< view/export_view.cpp
Work add_list(CLI::App& app);        ///< list.cpp
Work add_report(CLI::App& app);      ///< report.cpp
Work add_merge(CLI::App& app);       ///< merge.cpp
Work add_normal_map(CLI::App& app);  ///< normal_map.cpp

} // namespace shadowproof
