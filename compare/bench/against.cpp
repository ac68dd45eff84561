#include "compare/bench/against.h"

#include "compare/bench/kept.h"
#include "compare/words.h"

#include <fmt/format.h>

#include <algorithm>

namespace shadowproof {

namespace {

std::string name_of(const BenchPoint& point) {
    const std::string settings = words_of(point.settings);
    return point.scene + " " + point.technique + (settings.empty() ? "" : " " + settings);
}

const BenchScene* scene_named(const BenchRun& run, const std::string& name) {
    const auto found = std::find_if(run.scenes.begin(), run.scenes.end(),
                                    [&](const BenchScene& scene) { return scene.name == name; });
    return found == run.scenes.end() ? nullptr : &*found;
}

void compare_machines(const BenchRun& older, const BenchRun& newer, BenchChanges& changes) {
    const auto differ = [&](const char* what, const std::string& was, const std::string& is) {
        if (was != is)
            changes.notes.push_back(
                fmt::format("{} was {}, and is {}: times may differ for that", what, was, is));
    };
    differ("the processor", older.machine.processor, newer.machine.processor);
    differ("the number of cores", fmt::format("{}", older.machine.cores),
           fmt::format("{}", newer.machine.cores));
    differ("the driver", older.gl.renderer + ", " + older.gl.version,
           newer.gl.renderer + ", " + newer.gl.version);
    differ("Embree", older.embree, newer.embree);
}

/// Returns whether there are intervals to compare by.
bool compare_times(const BenchPoint& older, const BenchPoint& newer, BenchChanges& changes) {
    const TimeInterval was = median_interval(older.samples);
    const TimeInterval is = median_interval(newer.samples);
    const std::string words =
        fmt::format("{}: {:.3f} ms [{:.3f}, {:.3f}], was {:.3f} [{:.3f}, {:.3f}]", name_of(newer),
                    is.median, is.low, is.high, was.median, was.low, was.high);
    if (is_surely_slower(is, was)) changes.losses.push_back(words);
    if (is_surely_slower(was, is)) changes.gains.push_back(words);
    return was.is_known && is.is_known;
}

void compare_errors(const BenchPoint& older, const BenchPoint& newer, BenchChanges& changes) {
    const std::uint64_t was = wrong_pixels(older.error);
    const std::uint64_t is = wrong_pixels(newer.error);
    if (is != was)
        (is > was ? changes.losses : changes.gains)
            .push_back(fmt::format("{}: {} wrong, was {}", name_of(newer), counted(is, "pixel"),
                                   grouped(was)));
    if (!older.error.color || !newer.error.color) return;
    const double old_rmse = older.error.color->rmse;
    const double new_rmse = newer.error.color->rmse;
    if (new_rmse != old_rmse)
        (new_rmse > old_rmse ? changes.losses : changes.gains)
            .push_back(fmt::format("{}: colour rmse {:.6g}/255, was {:.6g}/255", name_of(newer),
                                   new_rmse, old_rmse));
}

/// The older run's point of the same scene, technique and settings, on the same picture; null where
/// there is none.
const BenchPoint* comparable_point(const BenchRun& older, const BenchRun& newer,
                                   const BenchPoint& point) {
    const BenchScene* const then = scene_named(older, point.scene);
    const BenchScene* const now = scene_named(newer, point.scene);
    if (then == nullptr || now == nullptr || !are_one_picture(*then, *now)) return nullptr;
    return find_point(older, point);
}

} // namespace

std::vector<ChangedOrder> changed_orders(const BenchRun& older, const BenchRun& newer) {
    struct Timed {
        std::size_t place; ///< in the newer run
        TimeInterval was;
        TimeInterval is;
    };
    std::vector<Timed> points;
    for (std::size_t i = 0; i < newer.points.size(); ++i)
        if (const BenchPoint* was = comparable_point(older, newer, newer.points[i]))
            points.push_back(
                {i, median_interval(was->samples), median_interval(newer.points[i].samples)});
    std::vector<ChangedOrder> changed;
    for (const Timed& quicker : points)
        for (const Timed& slower : points)
            if (newer.points[quicker.place].scene == newer.points[slower.place].scene &&
                is_surely_slower(slower.is, quicker.is) &&
                is_surely_slower(quicker.was, slower.was))
                changed.push_back({quicker.place, slower.place});
    return changed;
}

BenchChanges changes_between(const BenchRun& older, const BenchRun& newer) {
    BenchChanges changes;
    compare_machines(older, newer, changes);
    for (const BenchScene& scene : newer.scenes) {
        const BenchScene* was = scene_named(older, scene.name);
        if (was != nullptr && !are_one_picture(*was, scene))
            changes.notes.push_back(fmt::format(
                "{}: not compared: its content, size or light is not what it was", scene.name));
    }
    std::size_t added = 0;
    std::size_t untimed = 0;
    for (const BenchPoint& point : newer.points) {
        const BenchPoint* const was = find_point(older, point);
        if (was == nullptr) {
            ++added;
            continue;
        }
        if (comparable_point(older, newer, point) == nullptr) continue;
        ++changes.compared;
        compare_errors(*was, point, changes);
        if (!compare_times(*was, point, changes)) ++untimed;
    }
    for (const ChangedOrder& order : changed_orders(older, newer))
        changes.orders.push_back(
            fmt::format("{} is quicker than {} now, and was slower, beyond all intervals",
                        name_of(newer.points[order.quicker]), name_of(newer.points[order.slower])));
    if (untimed > 0)
        changes.notes.push_back(
            fmt::format("the times of {} are not compared: fewer than {} samples have no interval",
                        counted(untimed, "point"), least_samples));
    if (added > 0)
        changes.notes.push_back(
            fmt::format("{} the older run does not have", counted(added, "point")));
    const auto gone = static_cast<std::uint64_t>(
        std::count_if(older.points.begin(), older.points.end(), [&](const BenchPoint& point) {
            return find_point(newer, point) == nullptr;
        }));
    if (gone > 0)
        changes.notes.push_back(
            fmt::format("{} of the older run are not in this one", counted(gone, "point")));
    return changes;
}

} // namespace shadowproof
