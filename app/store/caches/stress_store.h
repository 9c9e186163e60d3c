// Keeps the stress of a project's scan on disk, so that it is computed once. The files may be deleted at any time.
//
// A file is named by a SHA-256 over the scan (points, triangles) and the load, and ends in a SHA-256 of its content: a
// file of another scan or a damaged one is ignored, and the stress is computed again
// (tests/app/store/caches/stress_store_test.cpp).

#pragma once

#include <filesystem>
#include <memory>

#include "base/context.h"
#include "segment/structure/stress.h"

namespace qchopper {

// From `folder`, or computed and kept there; if the folder cannot be written, it is not kept. Throws what stress_of
// throws.
std::shared_ptr<const StressedModel> kept_stress(const std::filesystem::path& folder, const TriangleMesh& scan,
                                                 const StructureOptions& load, const Context& context);

}  // namespace qchopper
