// Writes solids as one 3MF file (core specification 1.2): one object each, in millimetres.
//
// Points are written so that reading them gives the same doubles. Same solids, same bytes; the text goes into the
// package in stretches and never lies in memory whole (tests/segment/io/write_3mf_test.cpp).

#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/file.h"
#include "base/pose.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct Solid3mf {
    std::string name;                    // of the object
    const TriangleMesh* mesh = nullptr;  // stays the caller's
    Pose pose;                           // of the build item: from the mesh to where it is to be made
};

// What a slicer shows: "Title", "Application", ... Names are those of the specification or hold a namespace.
using Metadata3mf = std::vector<std::pair<std::string, std::string>>;

Bytes to_3mf(std::span<const Solid3mf> solids, const Metadata3mf& metadata);

}  // namespace qchopper
