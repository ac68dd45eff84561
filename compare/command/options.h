// Options that the subcommands share: scenes, techniques, size, time, outputs.
#pragma once

#include "compare/report/report.h"
#include "raster/gl/context.h"
#include "raster/technique.h"
#include "scenes/load/common/scene_request.h"
#include "scenes/memory_budget.h"
#include "scenes/stress/parameter.h"
#include "scenes/technique_settings.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Validator;
} // namespace CLI

namespace shadowproof {

/// A subcommand's work, returning an exit code; main() registers and runs them.
using Work = std::function<int()>;

struct PictureSize {
    int width = 512;
    int height = 512;
};

/// Which picture of a scene, and what making it may use.
struct SceneOptions {
    PictureSize size;
    bool size_given = false; ///< otherwise a camera's aspect ratio decides about the width
    std::optional<std::string> camera;
    std::optional<std::string> light;
    double time = 0; ///< seconds
    ViewOverride view{};
    std::optional<bool> floor; ///< under a model without camera or light; by default there is one
    std::optional<Stress> stress;
    int threads = 0; ///< 0: one per core
    MemoryBudget memory{};

    SceneRequest request() const;
    /// Whether all options are those of a scene's default picture.
    bool is_default() const;
};

struct TechniqueOptions {
    std::vector<const Technique*> techniques; ///< empty: all
    GlPlatform platform = GlPlatform::osmesa;
    TechniqueSettings asked{};

    std::vector<const Technique*> chosen() const;
};

/// Adds SCENE to a subcommand: one, which must be given, or any number, none for all bundled ones.
void add_scene_argument(CLI::App& command, std::string& scene);
void add_scenes_argument(CLI::App& command, std::vector<std::string>& scenes);

/// Adds the flags to a subcommand. Values are checked as they are parsed: a bad one is wrong usage,
/// and its message says what is possible.
void add_scene_flags(CLI::App& command, SceneOptions& options);
void add_technique_flags(CLI::App& command, TechniqueOptions& options);

/// --memory, whose default is default_memory_budget().
void add_memory_flag(CLI::App& command, MemoryBudget& budget);

/// --timeout, in seconds; `words`: its help text.
void add_timeout_flag(CLI::App& command, double& seconds, const std::string& words);

/// A finite number as std::from_chars reads it, the same in every locale, a + before it allowed.
std::optional<double> parse_number(const std::string& text);

/// A check for CLI11: the path may not be empty.
CLI::Validator not_empty();

/// A file name's extension in lower case: ".exr".
std::string extension_of(const std::string& file);

/// What to note of flags that were given and that no chosen technique heeds; empty where all count.
std::string unheeded_settings(const TechniqueOptions& options);

/// The flags that differ from their defaults, as words of a command line.
std::vector<std::string> settings(const SceneOptions& scene, const TechniqueOptions& technique);

} // namespace shadowproof
