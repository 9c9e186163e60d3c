// Keeps evaluations on disk, so that a later run does not evaluate a piece again. The files may be deleted at any time.
//
// A file is named by a SHA-256 over the piece (points, triangles, caps, half-spaces) and every setting that an
// evaluation depends on, and ends in a SHA-256 of its content: a file of another piece or a damaged one is ignored
// (tests/app/store/caches/evaluation_store_test.cpp).

#pragma once

#include <filesystem>

#include "segment/search/evaluation_cache.h"

namespace qchopper {

// `folder` is made when needed; if it cannot be written, nothing is kept. Neither function of the store throws
// InputError.
EvaluationStore evaluation_store(const std::filesystem::path& folder, const Objectives& objectives,
                                 const CandidateOptions& options);

}  // namespace qchopper
