// Sums over what the sweep gives.

#include "segment/score/cut_reach.h"

namespace qchopper {

std::vector<TiltBase> cap_bases(const Piece& piece) {
    std::vector<TiltBase> bases;
    for (const OwnedCap& cap : piece.samples->caps) bases.push_back({-cap.outward, cap.cut});
    return bases;
}

double scan_area_mm2(const Piece& piece) {
    const SurfaceSamples& samples = piece.samples->scan->samples;
    return samples.area_each_mm2 * static_cast<double>(samples.sample.size());
}

double unreachable_mm2(const PlaneReach& plane) {
    return least_unreachable_mm2(plane.above) + least_unreachable_mm2(plane.below);
}

CutReach cut_reach(const Piece& piece, const Plane& plane, double tilt_deg) {
    return cut_reach(piece, plane.normal, {&plane.offset, 1}, tilt_deg).front();
}

std::vector<CutReach> cut_reach(const Piece& piece, Vec3 normal, std::span<const double> offsets, double tilt_deg) {
    const JudgedPiece judged = piece.samples->judged();
    const ReachSweep sweep(piece, judged, cap_bases(piece), tilt_deg);
    std::vector<CutReach> reach;
    for (const PlaneReach& plane : sweep.sweep(normal, offsets)) {
        reach.push_back({unreachable_mm2(plane), scan_area_mm2(piece)});
    }
    return reach;
}

}  // namespace qchopper
