// Cuts the scan again and describes every piece before its cut. O(cuts) times the cost of a cut.

#include "app/store/plan.h"

#include <algorithm>
#include <cassert>

#include "app/store/replay.h"
#include "base/error.h"
#include "segment/mesh/connectivity/containment.h"

namespace qchopper {
namespace {

std::vector<PathSide> path_of(const Piece& piece) {
    std::vector<PathSide> path;
    for (const HalfSpace& half_space : piece.half_spaces) path.push_back({half_space.cut, half_space.above});
    return path;
}

const Piece& existing_piece(const Segmentation& segmentation, const std::string& name) {
    const std::optional<std::size_t> p = piece_named(segmentation, name);
    assert(p);
    return segmentation.pieces[*p];
}

PlanPiece plan_piece(const Piece& piece, Vec3 centre) {
    const std::optional<Vec3> inside = interior_point(*piece.mesh);
    if (!inside) throw InputError(InputFault::mesh, "piece " + piece.name + " has no inside", "check the scan");
    return {piece.name, path_of(piece), *inside + centre, volume_mm3(*piece.mesh)};
}

PlanCut plan_cut(const Cut& cut, const Piece& piece, Vec3 centre) {
    PlanCut p{plan_piece(piece, centre), cut.number, {}, cut.chosen.plane.offset, {}};
    p.plane = {cut.chosen.plane.normal, p.from_centre + height(cut.chosen.plane.normal, centre)};
    return p;
}

// What is discarded after so many cuts as the segmentation has.
void add_discards(Plan& plan, Segmentation& segmentation, const std::vector<Discard>& discards) {
    for (const Discard& d : discards) {
        if (d.after != segmentation.cuts.size()) continue;
        plan.discards.push_back(
            {plan_piece(existing_piece(segmentation, d.piece), plan.scan.centre), static_cast<std::int32_t>(d.after)});
        discard(segmentation, d.piece);
    }
}

}  // namespace

Plan make_plan(const Project& project, const TriangleMesh& scan) {
    const ScanSource& s = project.scan;
    const Box box = bounds(scan);
    Plan plan;
    plan.scan = {s.path.filename().string(),
                 to_hex(s.sha256),
                 s.unit,
                 s.scale,
                 s.centre,
                 s.faces,
                 s.volume_mm3,
                 {box.min + s.centre, box.max + s.centre}};
    plan.weights = project.settings.objectives.weights;
    const double fragment_volume = project.settings.objectives.fragment_volume_mm3;
    Segmentation segmentation = uncut(scan, fragment_volume);
    add_discards(plan, segmentation, project.discards);
    for (const Cut& cut : project.cuts) {
        PlanCut p = plan_cut(cut, existing_piece(segmentation, cut.piece), s.centre);
        apply(segmentation, cut, fragment_volume);
        for (const std::string& name : segmentation.cuts.back().pieces) {
            p.makes_mm3.push_back(volume_mm3(*existing_piece(segmentation, name).mesh));
        }
        std::sort(p.makes_mm3.rbegin(), p.makes_mm3.rend());
        plan.cuts.push_back(std::move(p));
        add_discards(plan, segmentation, project.discards);
    }
    return plan;
}

}  // namespace qchopper
