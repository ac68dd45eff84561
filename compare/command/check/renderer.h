// Runs the user's renderer for a scene: the command of --renderer.
#pragma once

#include "compare/command/check/options.h"
#include "compare/command/process/console.h"
#include "compare/output/unfinished.h"
#include "compare/report/report.h"

#include <filesystem>
#include <string>

namespace shadowproof {

/// A folder for what the renderer is given and writes. It is removed with all that is in it, also
/// where a signal ends the program.
class RenderFolder {
public:
    RenderFolder();
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    Unfinished removal_;
};

/// Throws std::invalid_argument, with a sentence, where the command names no {out}, another
/// placeholder than {scene}, {view}, {out}, {unlit} and {unshadowed}, or has a quote that does not
/// end.
void require_command(const std::string& command);

/// Has the renderer make its pictures of a scene, and adds them to the report as
/// rendered/SCENE/NAME.png. `name`: of the scene in the report. Throws Error where the command
/// fails, takes longer than options.timeout, or writes no picture.
SceneInputs render_scene(const CheckOptions& options, const std::string& scene,
                         const std::string& name, const std::filesystem::path& work,
                         const ReportFolder& folder, Console& console);

/// A message in which the renderer's files are named as they are in the report.
std::string as_in_report(std::string message, const std::filesystem::path& work);

} // namespace shadowproof
