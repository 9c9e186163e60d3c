// Evaluations kept on disk, so that another program need not evaluate a piece again. Deleting them is always safe.
//
// A file is named by a SHA-256 over the piece (points, triangles, caps, bounds) and every setting that a
// evaluation depends on, and ends in a SHA-256 of itself: a file that does not belong or is not whole is as if it were
// not there (tests/app/project/evaluation_store_test.cpp).

#pragma once

#include <filesystem>

#include "segment/search/evaluation_cache.h"

namespace qchopper {

// `folder` is made when needed; if it cannot be written, nothing is kept and nobody is troubled.
EvaluationStore evaluation_store(const std::filesystem::path& folder, const Objectives& objectives,
                                 const CandidateOptions& options);

}  // namespace qchopper
