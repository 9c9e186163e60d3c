#include "segment/score/pricing.h"

#include <tbb/parallel_for.h>

#include <mutex>

namespace qchopper {

std::vector<std::optional<Price>> price_all(const Piece& piece, std::span<const Candidate> candidates,
                                            const Objectives& objectives, const RayTree& scan_rays,
                                            const Context& context) {
    std::vector<std::optional<Price>> prices(candidates.size());
    std::mutex reporting;
    std::size_t done = 0;
    tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
        context.check_cancelled();
        prices[i] = price_by_cutting(piece, candidates[i].plane, objectives, scan_rays);
        const std::lock_guard lock(reporting);
        context.progress("planes priced", ++done, candidates.size());
    });
    return prices;
}

}  // namespace qchopper
