// One call of piece_access() per piece; its cost is that of casting the rays of 4,000 samples.

#include "app/jobs/unreachable_of.h"

#include "segment/access/piece_access.h"

namespace qchopper {

UnreachableOf unreachable_of(double tilt_deg) {
    PieceAccessOptions options;
    options.tilt_deg = tilt_deg;
    options.takes_kept = true;
    options.asks_dense = false;
    return [options](const Piece& piece) {
        const std::vector<PieceBase> bases = bases_of(piece);
        const PieceAccess access = piece_access(piece, bases, options);
        const BaseAccess& best = access.best();
        return UnreachableSurface{best.unreachable_mm2, best.share()};
    };
}

std::optional<double> share_by_objective(const Piece& piece, double tilt_deg) {
    if (!piece.samples) return std::nullopt;
    return area_on_best_base(piece, tilt_deg).share();
}

}  // namespace qchopper
