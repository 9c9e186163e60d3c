// A step may leave work for an earlier one: a filled open component coincides with its fill, a dropped face leaves
// points unused. So all steps run again until a pass changes nothing. The cost of a pass is that of its steps.

#include "segment/repair/settle.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "segment/mesh/connectivity/edges.h"
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

constexpr std::size_t max_passes = 12;

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
        report_.faces_turned += counts.faces_turned;
        if (report_.passes == 1) {  // later passes find the same ones: they begin with a weld
            report_.edges_split = counts.edges_split;
            report_.edges_cut = counts.edges_cut;
            report_.stitched = counts.stitched;
            report_.points_copied = counts.copies;
        }
        return counts.faces_turned > 0;
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
        report_.shells_turned += counts.turned;
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

}  // namespace

void settle(RepairState& state, const RepairOptions& options, StepProgress& progress) {
    Settling(state, options, progress).run();
}

}  // namespace qchopper
