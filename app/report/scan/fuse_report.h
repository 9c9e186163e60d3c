// The result of fuse: lines for people, one JSON document for programs. O(scans).

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/report/document.h"
#include "segment/fuse/fuse.h"

namespace qchopper {

// A line for each scan, what was aligned, the mesh and the next step.
std::vector<std::string> lines(const Fused& fused, const std::filesystem::path& out);
// The document qchopper-fuse-1 (docs/user/fuse.md).
Document document(const Fused& fused, const std::filesystem::path& out);

}  // namespace qchopper
