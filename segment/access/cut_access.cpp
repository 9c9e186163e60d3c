// Sums over what the sweep gives, or the pieces that a cut makes.

#include "segment/access/cut_access.h"

#include "segment/cut/cut_piece.h"
#include "segment/mesh/measure.h"

namespace qchopper {

AccessSweep access_sweep(const Piece& piece, double tilt_deg) {
    std::vector<TiltBase> bases;
    for (const OwnedCap& cap : piece.samples->caps) bases.push_back({-cap.outward, cap.cut});
    return {piece, piece.samples->judged(), bases, tilt_deg};
}

double scan_area_mm2(const Piece& piece) {
    const SurfaceSamples& samples = piece.samples->scan->samples;
    return samples.area_each_mm2 * static_cast<double>(samples.sample.size());
}

double unreachable_mm2(const PlaneAccess& plane) {
    return best_base(plane.above).unreachable_mm2 + best_base(plane.below).unreachable_mm2;
}

CutAccess cut_access(const Piece& piece, const Plane& plane, double tilt_deg) {
    return cut_access(piece, plane.normal, {&plane.offset, 1}, tilt_deg).front();
}

std::optional<double> unreachable_when_cut_mm2(const Piece& piece, const Plane& plane, double fragment_volume_mm3,
                                               double tilt_deg) {
    std::optional<CutPieces> made = cut_piece(piece, plane, new_cut);
    if (!made) return std::nullopt;
    sample_parts(piece, *made);
    double unreachable = 0;
    for (const Piece& part : made->pieces) {
        if (volume_mm3(*part.mesh) >= fragment_volume_mm3) unreachable += unreachable_mm2(part, tilt_deg);
    }
    return unreachable;
}

std::vector<CutAccess> cut_access(const Piece& piece, Vec3 normal, std::span<const double> offsets, double tilt_deg) {
    std::vector<CutAccess> access;
    for (const PlaneAccess& plane : access_sweep(piece, tilt_deg).sweep(normal, offsets)) {
        access.push_back({unreachable_mm2(plane), scan_area_mm2(piece)});
    }
    return access;
}

}  // namespace qchopper
