// The exit codes of the program, for scripts and build servers.
#pragma once

namespace shadowproof {

enum ExitCode : int {
    exit_passed = 0,    ///< agrees, or fails as predicted
    exit_failed = 1,    ///< a defect or an unexplained pixel
    exit_usage = 2,     ///< wrong usage
    exit_could_not = 3, ///< unreadable scene, no OpenGL, blank or NaN render
};

} // namespace shadowproof
