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
    std::string unshadowed;
    std::string renderer; ///< the command that makes a picture of each scene; empty: none
    std::string name;     ///< of the renderer's cells
    SceneOptions view;
    bool with_size = false; ///< the pictures' size was given; else it is their own
    GateOptions gate;
    OutputOptions output;
    bool alignment = true; ///< pictures of another view are refused
    bool diagnosis = true;
    bool controls = false;          ///< negative controls: faults are injected, and must be caught
    double timeout = usual_timeout; ///< seconds for a picture, for a run of the renderer, or for
                                    ///< tracing the scene; 0: no limit
};

/// The view of a scene that other renderers draw: what is in its file, without the default floor
/// unless that is requested.
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
    std::string unshadowed;
    std::filesystem::path work{}; ///< folder of the renderer's files; messages omit it, because the
                                  ///< report names its copies by the rest of the path
};

} // namespace shadowproof
