// Keeps the distances of an uncut scan's samples on disk, so that a project that is opened again casts no rays for
// them. The files may be deleted at any time.
//
// A file is named by a SHA-256 over the solids, the samples and the directions, and ends in a SHA-256 of its content: a
// file of another scan or a damaged one is ignored (tests/app/store/caches/distance_store_test.cpp). 21 MB for 20,000
// samples and 264 directions.

#pragma once

#include <filesystem>

#include "segment/access/sampled_piece.h"

namespace qchopper {

// `folder` is made when needed; if it cannot be written, nothing is kept. Neither function of the store throws
// InputError.
DistanceStore distance_store(const std::filesystem::path& folder);

}  // namespace qchopper
