#include "compare/command/scene_result.h"

#include "scenes/load/catalog.h"
#include "scenes/load/digest.h"
#include "scenes/plan/plan.h"

namespace shadowproof {

void describe(SceneResult& result, const Scene& scene) {
    result.light = chosen_light(scene);
    // A bundled scene is the same wherever it is installed, and so is its report.
    result.file = (is_bundled(result.argument) ? scene.file.filename() : scene.file).string();
    result.width = scene.camera.width;
    result.height = scene.camera.height;
    result.triangles = scene.triangles.size();
    result.digest = digest_of(scene);
    result.camera = scene.camera;
    result.far = finite_far(scene);
    result.meshes = scene.meshes;
    for (const Cause cause : scene.provokes) result.provokes.emplace_back(name_of(cause));
    result.notes = scene.notes;
}

} // namespace shadowproof
