// Between a project and the segmentation that its decisions make.
//
// Scan and decisions give the same pieces again, bit for bit (tests/app/project/project_test.cpp).

#pragma once

#include <cstddef>
#include <functional>

#include "app/project/project.h"

namespace qchopper {

// Copies what the segmentation says now into the project: cuts, then discarded pieces, that the history does not have
// yet are decided, cuts at its end that the segmentation has no more are given up (decisions.h, follow).
void record(Project& project, const Segmentation& segmentation);

// Applies the first `cuts` of the cuts that stand to the scan exactly as they were made, and takes out what was
// discarded before the next. Throws InputError (config) if a cut misses or a piece is not there.
Segmentation replay(const Project& project, const TriangleMesh& scan, std::size_t cuts);
// All of them.
Segmentation replay(const Project& project, const TriangleMesh& scan);

// Where the search of a project goes on: at its beam if it has one. `standing` is what its cuts make.
BeamProgress beam_progress(const Project& project, const Segmentation& standing,
                           const std::function<const TriangleMesh&()>& scan);

}  // namespace qchopper
