#include "segment/repair/repair.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

#include "base/error.h"
#include "segment/mesh/edges.h"
#include "segment/mesh/measure.h"
#include "segment/repair/balance.h"
#include "segment/repair/border_weld.h"
#include "segment/repair/crumbs.h"
#include "segment/repair/faces.h"
#include "segment/repair/loose_sheets.h"
#include "segment/repair/no_area.h"
#include "segment/repair/outwards.h"
#include "segment/repair/sheets.h"
#include "segment/repair/weld.h"

namespace qchopper {
namespace {

constexpr std::size_t most_passes = 12;
constexpr int most_resolvings = 4;

void check(const RepairOptions& o) {
    const auto is_length = [](double x) { return std::isfinite(x) && x >= 0; };
    if (!is_length(o.weld_mm) || !is_length(o.wrap_mm) || !std::isfinite(o.mm_per_unit) || !(o.mm_per_unit > 0) ||
        !is_length(o.fill.flat_chord_share)) {
        throw InputError(InputFault::use, "lengths for the repair must be positive numbers in mm",
                         "see qchopper repair --help");
    }
}

// One mesh on its way through the steps. Meanwhile cap_of says which face of the scan a face is; no_cap: a new one.
class Repairing {
 public:
    Repairing(TriangleMesh scan, const RepairOptions& options, const Context& context)
        : options_(options), context_(context), mesh_(std::move(scan)) {
        check(options);
        report_.faces_in = mesh_.triangles.size();
        report_.points_in = mesh_.points.size();
        mesh_.cap_of.resize(mesh_.triangles.size());
        std::iota(mesh_.cap_of.begin(), mesh_.cap_of.end(), 0);
        if (options.measure_deviation) before_ = mesh_;
    }

    Repaired run() {
        weld_points();
        if (options_.wrap_mm > 0 && !mesh_.triangles.empty()) {
            wrap_up();
        } else {
            settle();
            resolve();
        }
        smooth();
        finish();
        return {std::move(mesh_), std::move(report_)};
    }

 private:
    void step(const std::string& what) {
        context_.check_cancelled();
        context_.progress(what, ++steps_, 0);
    }

    void weld_points() {
        step("points welded");
        const WeldCounts counts = weld(mesh_);
        report_.welded = counts.welded;
        report_.collapsed = counts.collapsed;
        report_.unreferenced = counts.unreferenced;
        const BorderWeld border = weld_borders(mesh_, options_.weld_mm / options_.mm_per_unit);
        report_.border_welded = border.welded;
        report_.border_moved_mm = border.farthest * options_.mm_per_unit;
    }

    // A step may make work for an earlier one: a sheet that is closed lies on itself, a point stands alone.
    void settle() {
        for (std::size_t pass = 0; pass < most_passes && !mesh_.triangles.empty(); ++pass) {
            ++report_.passes;
            if (!pass_over() || pass + 1 == most_passes) return;  // welded, what only touches would meet again
            const std::size_t added = new_faces();
            weld(mesh_);
            take_back(added);
        }
    }

    // What closed a hole may go again: so many faces were new before. A face that was changed is new too, but closes
    // nothing. Returns how many of those that closed holes went.
    std::size_t take_back(std::size_t new_before) {
        const std::size_t gone = std::min(new_before - new_faces(), report_.faces_added);
        report_.faces_added -= gone;
        return gone;
    }

    std::size_t new_faces() const {
        return static_cast<std::size_t>(std::count(mesh_.cap_of.begin(), mesh_.cap_of.end(), no_cap));
    }

    // True if it changed more than the next pass would make again.
    bool pass_over() {
        const Edges found = edges(mesh_);
        is_balanced_ = options_.drop_repeated && options_.split && is_balanced(mesh_, found);
        bool is_changed = false;
        if (!is_balanced_ || found.faults.is_closed() || !pair_faces(is_changed)) {
            is_changed = drop_faces(found);
            is_changed |= part_sheets();
        }
        if (mesh_.triangles.empty()) return is_changed;
        const EdgeFaults faults = edges(mesh_).faults;
        if (faults.non_manifold + faults.inconsistent > 0) return is_changed;  // a step that was switched off
        is_changed |= remove_flat();
        is_changed |= close();
        if (report_.sheets > 0) return false;  // no solid: what closed them stays, to be seen
        is_changed |= face_outwards();
        is_changed |= sort_out_crumbs();
        return is_changed;
    }

    // Instead of the two steps after it, for faces that bound something as they are. False where they bound nothing.
    bool pair_faces(bool& is_changed) {
        step("faces paired");
        const std::size_t added = new_faces();
        const std::optional<ShellCounts> counts = close_balanced(mesh_);
        is_balanced_ = counts.has_value();
        if (!counts) return false;
        report_.of_double_sheets += counts->cancelled - take_back(added);
        if (report_.passes == 1) {
            report_.edges_split = counts->edges_split;
            report_.points_copied = counts->copies;
        }
        is_changed = counts->cancelled > 0;
        return true;
    }

    bool drop_faces(const Edges& found) {
        if (!options_.drop_repeated) return false;
        step("repeated faces dropped");
        const std::size_t added = new_faces();
        const RepeatedFaces counts = drop_repeated_faces(mesh_, found);
        // Only faces of the scan are told of.
        const std::size_t scanned = counts.repeated + counts.of_sheets - take_back(added);
        report_.repeated += std::min(scanned, counts.repeated);
        report_.of_double_sheets += scanned - std::min(scanned, counts.repeated);
        return counts.repeated + counts.of_sheets > 0;
    }

    bool part_sheets() {
        if (!options_.split) return false;
        step("sheets parted");
        const SheetCounts counts = separate_sheets(mesh_, {options_.orient, options_.stitch});
        report_.faces_turned += counts.faces_turned;
        if (report_.passes == 1) {  // the next pass finds them again, since it begins with equal points welded
            report_.edges_split = counts.edges_split;
            report_.edges_cut = counts.edges_cut;
            report_.stitched = counts.stitched;
            report_.points_copied = counts.copies;
        }
        return counts.faces_turned > 0;
    }

    bool remove_flat() {
        if (!options_.remove_no_area) return false;
        step("faces without area removed");
        const NoArea counts = qchopper::remove_no_area(mesh_);
        report_.no_area_removed += counts.flipped + counts.dropped;
        report_.no_area_left = counts.left;
        return counts.flipped + counts.dropped > 0;
    }

    bool close() {
        step("holes closed");
        if (is_balanced_ && report_.holes_filled == 0) return false;  // nothing is open, and nothing was before
        FilledHoles holes = fill_holes(mesh_, options_.fill, context_);
        report_.holes_filled += holes.filled;
        report_.holes_faired += holes.faired;
        report_.faces_added += holes.triangles;
        report_.points_added += holes.points;
        report_.left_open = std::move(holes.left);
        const std::size_t added = new_faces();
        const Sheets sheets = judge_sheets(mesh_, options_.drop_loose_sheets ? loose_sheet_share : 0);
        take_back(added);
        report_.loose_sheets += sheets.dropped;
        report_.loose_sheet_faces += sheets.dropped_faces;
        report_.sheets = sheets.left;
        report_.first_sheet = sheets.first;
        report_.added_area_share = sheets.added_area_share;
        return holes.filled + sheets.dropped > 0;
    }

    bool face_outwards() {
        step("shells turned outwards");
        if (!report_.left_open.empty()) return false;
        const Outwards counts = is_balanced_ ? turn_touching_outwards(mesh_, options_.turn_outwards)
                                             : turn_outwards(mesh_, options_.turn_outwards);
        report_.shells = counts.shells;
        report_.cavities = counts.cavities;
        report_.overlapping = counts.overlapping;
        report_.left_inside_out = counts.left;
        report_.shells_turned += counts.turned;
        return counts.turned > 0;
    }

    bool sort_out_crumbs() {
        if (!report_.left_open.empty()) return false;
        step("crumbs counted");
        const CrumbCounts counts =
            options_.drop_crumbs ? drop_crumbs(mesh_, crumb_share) : count_crumbs(mesh_, crumb_share);
        report_.crumbs = options_.drop_crumbs ? report_.crumbs + counts.crumbs : counts.crumbs;
        report_.crumb_faces = options_.drop_crumbs ? report_.crumb_faces + counts.faces : counts.faces;
        report_.crumb_area_share =
            options_.drop_crumbs ? report_.crumb_area_share + counts.area_share : counts.area_share;
        report_.crumbs_dropped = options_.drop_crumbs;
        return options_.drop_crumbs && counts.crumbs > 0;
    }

    bool is_closed() const { return edges(mesh_).faults.is_closed(); }

    void resolve() {
        if (!options_.resolve_self_intersections || mesh_.triangles.empty() || report_.sheets > 0) return;
        for (int round = 0; round < most_resolvings; ++round) {
            step("self-intersections resolved");
            const bool was_closed = is_closed();
            const TriangleMesh kept = mesh_;
            const RepairReport kept_report = report_;
            const Resolved now = qchopper::resolve_self_intersections(mesh_, {}, context_);
            if (now.places > 0) {
                weld(mesh_);
                settle();
            }
            if (was_closed && (!is_closed() || !(volume_mm3(mesh_) > 0) || report_.sheets > kept_report.sheets)) {
                mesh_ = kept;
                report_ = kept_report;
                report_.resolving_undone = true;
                if (!report_.resolved) report_.resolved = Resolved{};
                report_.resolved->pairs = std::max(report_.resolved->pairs, now.pairs);
                report_.resolved->left = now.pairs;
                return;
            }
            tell(now);
            if (now.places == 0 || now.left == 0) return;
        }
    }

    void tell(const Resolved& now) {
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

    // The thresholds of marks are mm.
    void smooth() {
        if (!options_.smooth_marks || mesh_.triangles.empty()) return;
        step("marks lifted");
        TriangleMesh in_mm = mesh_;
        for (Vec3& p : in_mm.points) p = options_.mm_per_unit * p;
        const std::vector<Vec3> before = in_mm.points;
        report_.marks = smooth_marks(in_mm, options_.marks, context_);
        for (std::size_t v = 0; v < before.size(); ++v) {
            if (in_mm.points[v] != before[v]) mesh_.points[v] = (1 / options_.mm_per_unit) * in_mm.points[v];
        }
    }

    void wrap_up() {
        step("scan wrapped");
        TriangleMesh in_mm = mesh_;
        for (Vec3& p : in_mm.points) p = options_.mm_per_unit * p;
        WrapOptions wrapping;
        wrapping.alpha_mm = options_.wrap_mm;
        report_.wrapped = filled_in(wrapping, in_mm);
        mesh_ = wrap(in_mm, wrapping, context_);
        for (Vec3& p : mesh_.points) p = (1 / options_.mm_per_unit) * p;
        mesh_.cap_of.assign(mesh_.triangles.size(), no_cap);
        const Outwards counts = qchopper::turn_outwards(mesh_);
        report_.shells = counts.shells;
        report_.cavities = counts.cavities;
        report_.shells_turned = counts.turned;
    }

    void finish() {
        step("repair checked");
        report_.faces_out = mesh_.triangles.size();
        report_.points_out = mesh_.points.size();
        report_.faces_new = new_faces();
        report_.faces_gone = report_.faces_in - (report_.faces_out - report_.faces_new);
        mesh_.cap_of.clear();
        const EdgeFaults faults = edges(mesh_).faults;
        report_.open_edges = faults.open + faults.inconsistent + faults.non_manifold;
        if (report_.open_edges > 0) report_.first_open_edge = mesh_.points[mesh_.triangles[faults.first_triangle][0]];
        report_.volume = faults.is_closed() ? volume_mm3(mesh_) : 0;
        // Nobody is told of a result that is refused, and for a sheet, which lies on what closes it, it takes long.
        if (!options_.measure_deviation || !(report_.is_solid() || options_.fill.fill == Fill::none)) return;
        const double unit = options_.mm_per_unit;
        for (Vec3& p : before_.points) p = unit * p;
        TriangleMesh after = mesh_;
        for (Vec3& p : after.points) p = unit * p;
        DistanceOptions distance;
        distance.tolerance_mm = std::min(distance.tolerance_mm, 1e-6 * norm(bounds(before_).size()));
        report_.deviation = deviation(before_, after, distance, context_);
    }

    const RepairOptions& options_;
    const Context& context_;
    std::size_t steps_ = 0;
    TriangleMesh mesh_;
    TriangleMesh before_;
    bool is_balanced_ = false;  // the mesh of this pass, as it began
    RepairReport report_;
};

}  // namespace

Repaired repair(TriangleMesh scan, const RepairOptions& options, const Context& context) {
    return Repairing(std::move(scan), options, context).run();
}

}  // namespace qchopper
