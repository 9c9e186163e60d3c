// Welds, settles, resolves, smooths and measures: the order of docs/user/repair.md. Memory: two more copies of the
// mesh, one to measure the deviation and one to undo a resolving. The cost is that of the steps.

#include "segment/repair/repair.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "base/error.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/measure.h"
#include "segment/repair/balance.h"
#include "segment/repair/degenerate.h"
#include "segment/repair/faces.h"
#include "segment/repair/fragments.h"
#include "segment/repair/open_components.h"
#include "segment/repair/orient_outward.h"
#include "segment/repair/split_non_manifold.h"
#include "segment/repair/weld.h"

namespace qchopper {
namespace {

// A scan during its repair.
struct RepairState {
    TriangleMesh mesh;
    SourceFaces sources;  // of the mesh
    RepairReport report;
};

struct StepProgress {
    const Context& context;
    std::size_t steps = 0;  // begun so far
    // `what` names the step, as "edges paired". Throws Cancelled if the context asks for it.
    void begin(const std::string& what) {
        context.check_cancelled();
        context.progress("steps of the repair (" + what + ")", ++steps, 0);
    }
};

constexpr std::size_t max_passes = 12;

// The steps that make closed shells of a surface, repeated until a pass over them changes nothing: a step may leave
// work for an earlier one, as a filled open component coincides with its fill, and a dropped face leaves points unused.
// At most twelve passes; their counts are added to the report. Precondition: equal points are welded, the mesh has no
// caps.
class Settling {
 public:
    Settling(RepairState& state, const RepairOptions& options, StepProgress& progress)
        : options_(options), progress_(progress), mesh_(state.mesh), sources_(state.sources), report_(state.report) {}

    void run() {
        for (std::size_t pass = 0; pass < max_passes && !mesh_.triangles.empty(); ++pass) {
            ++report_.passes;
            if (!run_steps() || pass + 1 == max_passes) return;  // a weld would join what only touches
            const std::size_t new_before = count_new(sources_);
            weld(mesh_, &sources_);
            discount_dropped(new_before);
        }
    }

 private:
    // A step may drop faces that fill holes: `new_before` faces were new before it. New are also faces with changed
    // corners, which fill nothing. Subtracts the dropped fill from the report and returns its number of faces.
    std::size_t discount_dropped(std::size_t new_before) {
        const std::size_t dropped = std::min(new_before - count_new(sources_), report_.faces_added);
        report_.faces_added -= dropped;
        return dropped;
    }

    // Returns whether the mesh changed in a way that needs another pass.
    bool run_steps() {
        const Edges found = edges(mesh_);
        is_balanced_ = options_.drop_repeated && options_.split && is_balanced(mesh_, found);
        bool is_changed = false;
        if (!is_balanced_ || found.faults.is_closed() || !pair_faces(is_changed)) {
            is_changed = drop_faces(found);
            is_changed |= split();
        }
        if (mesh_.triangles.empty()) return is_changed;
        const EdgeFaults faults = edges(mesh_).faults;
        if (faults.non_manifold + faults.inconsistent > 0) return is_changed;  // a step is switched off
        is_changed |= remove_flat();
        is_changed |= fill();
        if (report_.open_components_left > 0) return false;  // no solid: the fill stays, so that it can be checked
        is_changed |= turn_outwards();
        is_changed |= handle_fragments();
        return is_changed;
    }

    // Replaces drop_faces and split for a balanced mesh. Returns false where the mesh encloses nothing.
    bool pair_faces(bool& is_changed) {
        progress_.begin("faces paired");
        const std::size_t new_before = count_new(sources_);
        const std::optional<ShellCounts> counts = close_balanced(mesh_, &sources_);
        is_balanced_ = counts.has_value();
        if (!counts) return false;
        report_.of_doubled_components += counts->cancelled - discount_dropped(new_before);
        if (report_.passes == 1) {
            report_.edges_split = counts->edges_split;
            report_.points_copied = counts->copies;
        }
        is_changed = counts->cancelled > 0;
        return true;
    }

    bool drop_faces(const Edges& found) {
        if (!options_.drop_repeated) return false;
        progress_.begin("repeated faces dropped");
        const std::size_t new_before = count_new(sources_);
        const RepeatedFaces counts = drop_repeated_faces(mesh_, found, &sources_);
        // The report counts faces of the scan only.
        const std::size_t scanned = counts.repeated + counts.of_doubled_components - discount_dropped(new_before);
        const std::size_t repeated = std::min(scanned, counts.repeated);
        report_.repeated += repeated;
        report_.of_doubled_components += scanned - repeated;
        return counts.repeated + counts.of_doubled_components > 0;
    }

    bool split() {
        if (!options_.split) return false;
        progress_.begin("non-manifold edges split");
        const SplitCounts counts = split_non_manifold(mesh_, {options_.orient, options_.stitch});
        report_.faces_reoriented += counts.faces_reoriented;
        if (report_.passes == 1) {  // later passes find the same ones: they begin with a weld
            report_.edges_split = counts.edges_split;
            report_.edges_cut = counts.edges_cut;
            report_.stitched = counts.stitched;
            report_.points_copied = counts.copies;
        }
        return counts.faces_reoriented > 0;
    }

    bool remove_flat() {
        if (!options_.remove_degenerate) return false;
        progress_.begin("faces without area removed");
        const Degenerate counts = remove_degenerate(mesh_, &sources_);
        report_.degenerate_removed += counts.flipped + counts.dropped;
        report_.degenerate_left = counts.left;
        return counts.flipped + counts.dropped > 0;
    }

    bool fill() {
        progress_.begin("holes closed");
        if (is_balanced_ && report_.holes_filled == 0) return false;  // nothing is open, and nothing was before
        FilledHoles holes = fill_holes(mesh_, options_.fill, progress_.context);
        sources_.of.resize(mesh_.triangles.size(), new_face);
        report_.holes_filled += holes.filled;
        report_.holes_faired += holes.faired;
        report_.faces_added += holes.triangles;
        report_.points_added += holes.points;
        report_.left_open = std::move(holes.left);
        const std::size_t new_before = count_new(sources_);
        const OpenComponents open_components =
            drop_open_components(mesh_, sources_, options_.drop_open_components ? open_component_share : 0);
        discount_dropped(new_before);
        report_.open_components_dropped += open_components.dropped;
        report_.open_component_faces += open_components.dropped_faces;
        report_.open_components_left = open_components.left;
        report_.first_open_component = open_components.first;
        report_.added_area_share = open_components.added_area_share;
        return holes.filled + open_components.dropped > 0;
    }

    bool turn_outwards() {
        progress_.begin("shells turned outwards");
        if (!report_.left_open.empty()) return false;
        const Outward counts = is_balanced_ ? orient_touching_outward(mesh_, options_.orient_outward)
                                            : orient_outward(mesh_, options_.orient_outward);
        report_.shells = counts.shells;
        report_.cavities = counts.cavities;
        report_.overlapping = counts.overlapping;
        report_.left_inside_out = counts.left;
        report_.shells_reoriented += counts.turned;
        return counts.turned > 0;
    }

    // Dropped fragments add up over the passes; counted ones are those of the last pass.
    bool handle_fragments() {
        if (!report_.left_open.empty()) return false;
        progress_.begin("fragments counted");
        const bool is_dropping = options_.drop_fragments;
        const FragmentCounts counts =
            is_dropping ? drop_fragments(mesh_, fragment_share, &sources_) : count_fragments(mesh_, fragment_share);
        report_.fragments = counts.fragments + (is_dropping ? report_.fragments : 0);
        report_.fragment_faces = counts.faces + (is_dropping ? report_.fragment_faces : 0);
        report_.fragment_area_share = counts.area_share + (is_dropping ? report_.fragment_area_share : 0);
        report_.fragments_dropped = is_dropping;
        return is_dropping && counts.fragments > 0;
    }

    const RepairOptions& options_;
    StepProgress& progress_;
    TriangleMesh& mesh_;
    SourceFaces& sources_;
    RepairReport& report_;
    bool is_balanced_ = false;  // the mesh at the beginning of the pass
};

constexpr int max_resolvings = 4;

void check(const RepairOptions& o) {
    const auto is_length = [](double x) { return std::isfinite(x) && x >= 0; };
    if (!is_length(o.snap_borders_mm) || !is_length(o.alpha_wrap_mm) || !std::isfinite(o.mm_per_unit) ||
        !(o.mm_per_unit > 0) || !is_length(o.fill.flat_chord_share)) {
        throw InputError(InputFault::use, "lengths for the repair must be finite and not negative, in mm",
                         Sentence::with_key("help_of_repair", {}, "give lengths of 0 or more"));
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
            Settling(state_, options_, progress_).run();
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
        const SnapBorders border = snap_borders(mesh_, options_.snap_borders_mm / options_.mm_per_unit, &sources_);
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
                Settling(state_, options_, progress_).run();
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
        report_.shells_reoriented = counts.turned;
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
