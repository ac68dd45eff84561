#include "compare/bench/kept.h"

#include <algorithm>

namespace shadowproof {

namespace {

BenchScene* scene_named(BenchRun& run, const std::string& name) {
    const auto found = std::ranges::find(run.scenes, name, &BenchScene::name);
    return found == run.scenes.end() ? nullptr : &*found;
}

bool are_one_line(const Growth& a, const Growth& b) {
    return a.axis == b.axis && a.scene == b.scene && a.technique == b.technique &&
           a.command == b.command;
}

void add_points(BenchRun& run, const BenchRun& earlier) {
    for (const BenchScene& scene : earlier.scenes) {
        BenchScene* const now = scene_named(run, scene.name);
        if (now != nullptr && !are_one_picture(*now, scene)) continue;
        bool has_more = false;
        for (const BenchPoint& point : earlier.points) {
            if (point.scene != scene.name || find_point(run, point) != nullptr) continue;
            has_more = true;
            run.points.push_back(point);
            run.points.back().pictures.clear();
        }
        if (now == nullptr) {
            run.scenes.push_back(scene);
            run.finished = run.finished && scene.finished;
        } else {
            now->finished = now->finished && (scene.finished || !has_more);
        }
    }
}

void add_growth(BenchRun& run, const BenchRun& earlier) {
    for (const Growth& growth : earlier.growth) {
        const auto now = std::ranges::find_if(
            run.growth, [&](const Growth& each) { return are_one_line(each, growth); });
        if (now == run.growth.end())
            run.growth.push_back(growth);
        else if (now->points.size() < growth.points.size())
            *now = growth;
    }
}

/// Whether the run has what was left out earlier, or says itself why not.
bool is_settled_by(const BenchRun& run, const BenchLeftOut& out) {
    const auto is_same = [&](const auto& each) {
        return each.scene == out.scene && each.technique == out.technique &&
               each.settings == out.settings;
    };
    const auto is_its_line = [&](const Growth& each) {
        return each.axis == out.axis &&
               (out.technique.empty() ||
                (each.scene == out.scene && each.technique == out.technique));
    };
    const auto is_its_scene = [&](const BenchScene& each) {
        return each.name == out.scene || each.file == out.scene;
    };
    if (std::ranges::any_of(run.left_out, [&](const BenchLeftOut& each) {
            return is_same(each) && each.axis == out.axis;
        }))
        return true;
    if (!out.axis.empty()) return std::ranges::any_of(run.growth, is_its_line);
    return out.technique.empty() ? std::ranges::any_of(run.scenes, is_its_scene)
                                 : std::ranges::any_of(run.points, is_same);
}

} // namespace

bool are_one_picture(const BenchScene& a, const BenchScene& b) {
    return a.digest == b.digest && a.width == b.width && a.height == b.height && a.light == b.light;
}

BenchRun with_kept(BenchRun run, const BenchRun& earlier) {
    std::erase_if(run.points, [](const BenchPoint& point) { return point.samples.empty(); });
    std::vector<BenchLeftOut> left_out;
    for (const BenchLeftOut& out : earlier.left_out)
        if (!is_settled_by(run, out)) left_out.push_back(out);
    add_points(run, earlier);
    add_growth(run, earlier);
    run.left_out.insert(run.left_out.end(), left_out.begin(), left_out.end());
    return run;
}

} // namespace shadowproof
