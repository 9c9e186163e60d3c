// Writes solids as one 3MF file (core specification 1.2): one object each, in millimetres.
//
// Points are written with all digits, so that reading gives the same doubles. The same solids give the same bytes, by
// the same version of zlib. The text of the model is never in memory whole (tests/segment/io/write_3mf_test.cpp).

#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/files/file.h"
#include "base/pose.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct Solid3mf {
    std::string name;                    // of the object
    const TriangleMesh* mesh = nullptr;  // not null; owned by the caller
    Pose pose;                           // of the build item: from the mesh to where it is to be made
};

// Shown by slicers: "Title", "Application", ... Names are those of the specification or have a namespace.
using Metadata3mf = std::vector<std::pair<std::string, std::string>>;

Bytes to_3mf(std::span<const Solid3mf> solids, const Metadata3mf& metadata);

}  // namespace qchopper
