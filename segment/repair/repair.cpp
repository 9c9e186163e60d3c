// Welds, settles, resolves, smooths and measures: the order of docs/user/repair.md. Memory: two more copies of the
// mesh, one to measure the deviation and one to undo a resolving. The cost is that of the steps.

#include "segment/repair/repair.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/measure.h"
#include "segment/repair/orient_outward.h"
#include "segment/repair/settle.h"
#include "segment/repair/snap_borders.h"
#include "segment/repair/weld.h"

namespace qchopper {
namespace {

constexpr int max_resolvings = 4;

void check(const RepairOptions& o) {
    const auto is_length = [](double x) { return std::isfinite(x) && x >= 0; };
    if (!is_length(o.weld_mm) || !is_length(o.alpha_wrap_mm) || !std::isfinite(o.mm_per_unit) || !(o.mm_per_unit > 0) ||
        !is_length(o.fill.flat_chord_share)) {
        throw InputError(InputFault::use, "lengths for the repair must be finite and not negative, in mm",
                         "see qchopper repair --help");
    }
}

TriangleMesh scaled(TriangleMesh mesh, double factor) {
    for (Vec3& p : mesh.points) p = factor * p;
    return mesh;
}

class Repairing {
 public:
    Repairing(TriangleMesh scan, const RepairOptions& options, const Context& context)
        : options_(options), context_(context), state_{std::move(scan), {}, {}} {
        check(options);
        mesh_.cap_of.clear();
        report_.faces_in = mesh_.triangles.size();
        report_.points_in = mesh_.points.size();
        sources_.of.resize(mesh_.triangles.size());
        std::iota(sources_.of.begin(), sources_.of.end(), 0);
        if (options.measure_deviation) before_ = mesh_;
    }

    Repaired run() {
        weld_points();
        if (options_.alpha_wrap_mm > 0 && !mesh_.triangles.empty()) {
            alpha_wrap_scan();
        } else {
            settle(state_, options_, progress_);
            resolve();
        }
        smooth();
        finish();
        return {std::move(mesh_), std::move(report_)};
    }

 private:
    void weld_points() {
        progress_.begin("points welded");
        const WeldCounts counts = weld(mesh_, &sources_);
        report_.welded = counts.welded;
        report_.collapsed = counts.collapsed;
        report_.unreferenced = counts.unreferenced;
        const SnapBorders border = weld_borders(mesh_, options_.weld_mm / options_.mm_per_unit, &sources_);
        report_.borders_snapped = border.welded;
        report_.border_moved_mm = border.farthest * options_.mm_per_unit;
    }

    bool is_closed() const { return edges(mesh_).faults.is_closed(); }

    void resolve() {
        if (!options_.resolve_self_intersections || mesh_.triangles.empty() || report_.open_components_left > 0) return;
        for (int round = 0; round < max_resolvings; ++round) {
            progress_.begin("self-intersections resolved");
            const bool was_closed = is_closed();
            const RepairState kept = state_;
            const Resolved now = resolve_self_intersections(mesh_, {}, context_, &sources_);
            if (now.places > 0) {
                weld(mesh_, &sources_);
                settle(state_, options_, progress_);
            }
            if (was_closed && (!is_closed() || !(volume_mm3(mesh_) > 0) ||
                               report_.open_components_left > kept.report.open_components_left)) {
                state_ = kept;
                report_.resolving_undone = true;
                if (!report_.resolved) report_.resolved = Resolved{};
                report_.resolved->pairs = std::max(report_.resolved->pairs, now.pairs);
                report_.resolved->left = now.pairs;
                return;
            }
            add(now);
            if (now.places == 0 || now.left == 0) return;
        }
    }

    void add(const Resolved& now) {
        if (!report_.resolved) {
            report_.resolved = now;
            return;
        }
        Resolved& all = *report_.resolved;
        all.left = now.left;
        all.places += now.places;
        all.removed += now.removed;
        all.added += now.added;
        all.dropped += now.dropped;
        all.where_left = now.where_left;
    }

    // The limits of pen grooves are mm. Points that do not move keep their bits.
    void smooth() {
        if (!options_.smooth_pen_grooves || mesh_.triangles.empty()) return;
        progress_.begin("pen grooves lifted");
        TriangleMesh in_mm = scaled(mesh_, options_.mm_per_unit);
        const std::vector<Vec3> before = in_mm.points;
        report_.pen_grooves = smooth_pen_grooves(in_mm, options_.pen_grooves, context_);
        for (std::size_t v = 0; v < before.size(); ++v) {
            if (in_mm.points[v] != before[v]) mesh_.points[v] = (1 / options_.mm_per_unit) * in_mm.points[v];
        }
    }

    void alpha_wrap_scan() {
        progress_.begin("scan wrapped");
        const TriangleMesh in_mm = scaled(mesh_, options_.mm_per_unit);
        report_.alpha_wrapped = filled_in({options_.alpha_wrap_mm, 0}, in_mm);
        mesh_ = scaled(alpha_wrap(in_mm, *report_.alpha_wrapped, context_), 1 / options_.mm_per_unit);
        sources_.of.assign(mesh_.triangles.size(), new_face);
        const Outward counts = orient_outward(mesh_);
        report_.shells = counts.shells;
        report_.cavities = counts.cavities;
        report_.shells_turned = counts.turned;
    }

    void finish() {
        progress_.begin("repair checked");
        report_.faces_out = mesh_.triangles.size();
        report_.points_out = mesh_.points.size();
        report_.faces_new = count_new(sources_);
        report_.faces_gone = report_.faces_in - (report_.faces_out - report_.faces_new);
        const EdgeFaults faults = edges(mesh_).faults;
        report_.open_edges = faults.open + faults.inconsistent + faults.non_manifold;
        if (report_.open_edges > 0) report_.first_open_edge = mesh_.points[mesh_.triangles[faults.first_triangle][0]];
        report_.volume = faults.is_closed() ? volume_mm3(mesh_) : 0;
        // A result that is refused needs none, and that of an open component, which coincides with what fills it, takes
        // very long.
        if (!options_.measure_deviation || !(report_.is_solid() || options_.fill.fill == Fill::none)) return;
        const TriangleMesh before = scaled(std::move(before_), options_.mm_per_unit);
        DistanceOptions distance;
        distance.tolerance_mm = std::min(distance.tolerance_mm, 1e-6 * norm(bounds(before).size()));
        report_.deviation = deviation(before, scaled(mesh_, options_.mm_per_unit), distance, context_);
    }

    const RepairOptions& options_;
    const Context& context_;
    StepProgress progress_{context_};
    RepairState state_;
    TriangleMesh& mesh_ = state_.mesh;
    SourceFaces& sources_ = state_.sources;
    RepairReport& report_ = state_.report;
    TriangleMesh before_;
};

}  // namespace

Repaired repair(TriangleMesh scan, const RepairOptions& options, const Context& context) {
    return Repairing(std::move(scan), options, context).run();
}

}  // namespace qchopper
