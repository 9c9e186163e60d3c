// One stage after the other; each is in a file of its own. The cost is that of the stages.

#include "sim/replay/replay.h"

#include <algorithm>

#include "base/text.h"
#include "sim/replay/flush_check.h"
#include "sim/replay/gouge.h"
#include "sim/replay/reach/reachable.h"
#include "sim/replay/removal_rate_check.h"
#include "sim/replay/walk/machine_walk.h"

namespace qchopper {
namespace {

double largest_rounding(const ToolPath& path) {
    double largest = 0;
    for (std::size_t i = 0; i < path.lines.size(); ++i) {
        const TipLine* const next = path.after(i);
        if (next == nullptr || path.lines[i].rounding <= 0) continue;
        largest = std::max(largest, corner_of(path.lines[i], *next).deviation);
    }
    return largest;
}

void judge_gouge(const ReplayReport& report, const ReplayOptions& options, FindingLog& log) {
    if (report.largest_gouge > options.max_gouge) {
        log.add(FindingKind::gouge, report.gouge_place, report.largest_gouge, report.largest_gouge, [&] {
            return "the tool cuts " + fixed(report.largest_gouge, 3) + " mm into the piece, at " +
                   fixed(report.gouge_at.x, 1) + " " + fixed(report.gouge_at.y, 1) + " " + fixed(report.gouge_at.z, 1);
        });
    }
    const double beyond = report.volumes.beyond_mm3;
    if (beyond <= options.max_beyond_mm3) return;
    log.add(FindingKind::gouge_volume, {}, beyond, beyond,
            [&] { return fixed(beyond, 1) + " mm3 of the piece are cut away beyond tolerance"; });
}

void judge_given_up(const ReplayReport& report, const ReplayOptions& options, FindingLog& log) {
    const double share = report.share_given_up();
    if (share <= options.max_given_up) return;
    const GivenUp& most = report.leftover.given_up.front();
    log.add(FindingKind::given_up, {}, share, share, [&] {
        return fixed(report.leftover.given_up_mm2() / 100, 1) + " cm2, " + fixed(100 * share, 2) +
               " % of the surface, keep foam that tools of the cell reach and the program gives up, most of it tool " +
               std::to_string(most.tool) + " in orientation " + std::to_string(most.orientation + 1) + "; at most " +
               fixed(100 * options.max_given_up, 2) +
               " % may be given up, unless the operator names the tools that may be used";
    });
}

void judge_leftover(const ReplayReport& report, const ReplayOptions& options, FindingLog& log) {
    const double share = report.share_within();
    if (share < options.min_share) {
        log.add(FindingKind::leftover, {}, report.leftover.largest, 1 - share, [&] {
            return fixed(100 * share, 2) +
                   " % of the reachable surface are within tolerance, the most foam left on it is " +
                   fixed(report.leftover.largest, 2) + " mm";
        });
    }
    const double standing = report.volumes.standing_mm3;
    if (standing > options.max_standing_mm3) {
        const Vec3 at = report.volumes.standing_at;
        log.add(FindingKind::standing_foam, {}, standing, standing, [&] {
            return fixed(standing, 0) + " mm3 of foam stand beside the piece where the tools come to, at " +
                   fixed(at.x, 1) + " " + fixed(at.y, 1) + " " + fixed(at.z, 1);
        });
    }
}

double largest_radius(const ReplayScene& scene) {
    double radius = 0;
    for (const StockTool& used : used_tools(scene)) {
        for (const CuttingTool& tool : scene.cell->machine->tools) {
            if (tool.number == used.tool) radius = std::max(radius, 0.5 * tool.diameter);
        }
    }
    return radius;
}

std::vector<float> deviations(const GougeFigures& gouges, const LeftoverFigures& leftover) {
    std::vector<float> deviation = leftover.distance;
    deviation.resize(gouges.depth.size(), 0);
    for (std::size_t t = 0; t < deviation.size(); ++t) {
        if (gouges.depth[t] > deviation[t]) deviation[t] = -gouges.depth[t];
    }
    return deviation;
}

}  // namespace

ReplayReport replay(const ParsedProgram& program, const ReplayScene& scene, const ReplayOptions& options,
                    const Context& context) {
    check_scene(scene);
    FindingLog log;
    ReplayReport report;
    check_flush_faces(scene, log);
    const ToolPath path = walk_machine(program, scene, log, context);
    report.time = time_of(path, motion_limits(*scene.cell->machine));
    report.largest_rounding = largest_rounding(path);
    std::vector<Vec3> tool_axes;
    for (const SceneOrientation& orientation : scene.orientations) tool_axes.push_back(orientation.tool_axis);
    StockModel stock_model(scene.block, tool_axes, options.cell);
    if (scene.before != nullptr) stock_model.start_from(*scene.before);
    report.milling = mill_stock(stock_model, path, scene, options.is_worst, log, context);
    stock_model.end_milling();
    report.account = account_of(path, report.time, report.milling, *scene.cell->machine);
    check_removal_rate(path, report.milling.lines, scene, log);
    const GougeFigures gouges = find_gouges(path, scene, options.gouge_floor, context);
    check_beside_flush_faces(path, scene, log, context);
    report.largest_gouge = gouges.largest;
    report.gouge_place = gouges.place;
    report.gouge_at = gouges.at;
    if (scene.is_last) report.leftover = measure_leftover(stock_model, scene, gouges.depth, options.leftover, context);
    const VolumeOptions volumes{options.volume_cell, 2 * largest_radius(scene), options.max_gouge,
                                scene.scallop + options.leftover.too_much + options.cell};
    report.volumes = measure_volumes(stock_model, scene, volumes, context);
    report.deviation = deviations(gouges, report.leftover);
    judge_gouge(report, options, log);
    if (scene.is_last) judge_given_up(report, options, log);
    if (scene.is_last) judge_leftover(report, options, log);
    if (report.milling.cuts == 0) log.add(FindingKind::no_cut, {}, "the program removes nothing");
    if (!scene.is_last) {
        report.left = stock_model.record();
        report.left.tools = used_tools(scene);
    }
    report.findings = log.findings();
    report.counts = log.counts();
    report.is_good = report.findings.empty();
    return report;
}

}  // namespace qchopper
