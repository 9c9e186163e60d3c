// Keeps what seams on an uncut scan cost on disk, so that a project that is opened again casts no rays for it. The
// files may be deleted at any time.
//
// A file is named by a SHA-256 over the solids, and ends in a SHA-256 of its content: a file of another scan or a
// damaged one is ignored, and the costs are found again (tests/app/store/caches/seam_cost_store_test.cpp). 4 bytes a
// point.

#pragma once

#include <filesystem>
#include <span>

#include "base/context.h"
#include "segment/cut/piece.h"

namespace qchopper {

// find_seam_costs() (segment/objectives/seam_cost.h) with what `folder` holds, or computed and kept there; if the
// folder is empty or cannot be written, nothing is kept. Throws Cancelled.
void find_kept_seam_costs(const std::filesystem::path& folder, std::span<Piece> uncut, const Context& context);

}  // namespace qchopper
