// What `check` is asked for.
#pragma once

#include "compare/command/gate_options.h"
#include "compare/command/options.h"
#include "compare/command/pieces/supervisor.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowproof {

struct CheckOptions {
    std::vector<std::string> scenes; ///< one; or several, with a renderer
    std::vector<std::string> pictures;
    std::string mask; ///< empty: none
    std::string unlit;
    std::string renderer; ///< the command that makes a picture of each scene; empty: none
    std::string name;     ///< of the renderer's cells
    SceneOptions view;
    bool with_size = false; ///< the pictures' size was given; else it is their own
    GateOptions gate;
    OutputOptions output;
    bool alignment = true; ///< pictures of another view are refused
    bool diagnosis = true;
    bool controls = false;          ///< faults are made, and must be caught
    double timeout = usual_timeout; ///< seconds for a picture, for a run of the renderer, or for
                                    ///< tracing the scene; 0: no limit
};

/// The view of a scene that others draw: what is in its file, without a floor of ours unless that
/// is asked for.
inline SceneOptions drawn_by_others(SceneOptions view) {
    view.floor = view.floor.value_or(false);
    return view;
}

/// The files of one scene.
struct SceneInputs {
    std::string scene;
    std::vector<std::string> pictures;
    std::string mask; ///< empty: none
    std::string unlit;
    std::filesystem::path work{}; ///< of the renderer: messages leave it out, as the report's
                                  ///< copies of its pictures have the rest of their names
};

} // namespace shadowproof
