#include "segment/repair/settle.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "segment/mesh/edges.h"
#include "segment/repair/balance.h"
#include "segment/repair/degenerate.h"
#include "segment/repair/faces.h"
#include "segment/repair/fragments.h"
#include "segment/repair/open_components.h"
#include "segment/repair/orient_outward.h"
#include "segment/repair/sheets.h"
#include "segment/repair/weld.h"

namespace qchopper {
namespace {

constexpr std::size_t most_passes = 12;

class Settling {
 public:
    Settling(RepairState& state, const RepairOptions& options, StepProgress& progress)
        : options_(options), progress_(progress), mesh_(state.mesh), sources_(state.sources), report_(state.report) {}

    // A step may make work for an earlier one: a sheet that is closed lies on itself, a point stands alone.
    void run() {
        for (std::size_t pass = 0; pass < most_passes && !mesh_.triangles.empty(); ++pass) {
            ++report_.passes;
            if (!pass_over() || pass + 1 == most_passes) return;  // welded, what only touches would meet again
            const std::size_t added = count_new(sources_);
            weld(mesh_, &sources_);
            take_back(added);
        }
    }

 private:
    // What closed a hole may go again: so many faces were new before. A face that was changed is new too, but closes
    // nothing. Returns how many of those that closed holes went.
    std::size_t take_back(std::size_t new_before) {
        const std::size_t gone = std::min(new_before - count_new(sources_), report_.faces_added);
        report_.faces_added -= gone;
        return gone;
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
        is_changed |= face_outward();
        is_changed |= sort_out_fragments();
        return is_changed;
    }

    // Instead of the two steps after it, for faces that bound something as they are. False where they bound nothing.
    bool pair_faces(bool& is_changed) {
        progress_.begin("faces paired");
        const std::size_t added = count_new(sources_);
        const std::optional<ShellCounts> counts = close_balanced(mesh_, &sources_);
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
        progress_.begin("repeated faces dropped");
        const std::size_t added = count_new(sources_);
        const RepeatedFaces counts = drop_repeated_faces(mesh_, found, &sources_);
        // Only faces of the scan are told of.
        const std::size_t scanned = counts.repeated + counts.of_sheets - take_back(added);
        report_.repeated += std::min(scanned, counts.repeated);
        report_.of_double_sheets += scanned - std::min(scanned, counts.repeated);
        return counts.repeated + counts.of_sheets > 0;
    }

    bool part_sheets() {
        if (!options_.split) return false;
        progress_.begin("sheets parted");
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
        if (!options_.remove_degenerate) return false;
        progress_.begin("faces without area removed");
        const Degenerate counts = remove_degenerate(mesh_, &sources_);
        report_.degenerate_removed += counts.flipped + counts.dropped;
        report_.degenerate_left = counts.left;
        return counts.flipped + counts.dropped > 0;
    }

    bool close() {
        progress_.begin("holes closed");
        if (is_balanced_ && report_.holes_filled == 0) return false;  // nothing is open, and nothing was before
        FilledHoles holes = fill_holes(mesh_, options_.fill, progress_.context);
        sources_.of.resize(mesh_.triangles.size(), new_face);
        report_.holes_filled += holes.filled;
        report_.holes_faired += holes.faired;
        report_.faces_added += holes.triangles;
        report_.points_added += holes.points;
        report_.left_open = std::move(holes.left);
        const std::size_t added = count_new(sources_);
        const Sheets sheets = judge_sheets(mesh_, sources_, options_.drop_open_components ? open_component_share : 0);
        take_back(added);
        report_.open_components += sheets.dropped;
        report_.open_component_faces += sheets.dropped_faces;
        report_.sheets = sheets.left;
        report_.first_sheet = sheets.first;
        report_.added_area_share = sheets.added_area_share;
        return holes.filled + sheets.dropped > 0;
    }

    bool face_outward() {
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

    bool sort_out_fragments() {
        if (!report_.left_open.empty()) return false;
        progress_.begin("fragments counted");
        const FragmentCounts counts = options_.drop_fragments ? drop_fragments(mesh_, fragment_share, &sources_)
                                                              : count_fragments(mesh_, fragment_share);
        report_.fragments = options_.drop_fragments ? report_.fragments + counts.fragments : counts.fragments;
        report_.fragment_faces = options_.drop_fragments ? report_.fragment_faces + counts.faces : counts.faces;
        report_.fragment_area_share =
            options_.drop_fragments ? report_.fragment_area_share + counts.area_share : counts.area_share;
        report_.fragments_dropped = options_.drop_fragments;
        return options_.drop_fragments && counts.fragments > 0;
    }

    const RepairOptions& options_;
    StepProgress& progress_;
    TriangleMesh& mesh_;
    SourceFaces& sources_;
    RepairReport& report_;
    bool is_balanced_ = false;  // the mesh of this pass, as it began
};

}  // namespace

void settle(RepairState& state, const RepairOptions& options, StepProgress& progress) {
    Settling(state, options, progress).run();
}

}  // namespace qchopper
