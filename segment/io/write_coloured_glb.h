// Writes one mesh in several colours, and lines, as GLB (glTF 2.0, binary) for any viewer.
//
// mm with Z up in the numbers, single precision; the root node converts to metres with Y up. A primitive per colour of
// the mesh and per group of lines, each with a material of its name. Same input, same bytes
// (tests/segment/io/write_coloured_glb_test.cpp).

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/files/file.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct GlbColour {
    std::string name;
    std::array<double, 3> colour{};  // linear red, green, blue
};

struct GlbLines {
    std::string node;  // "path/orientation 1"
    GlbColour colour;
    std::vector<std::vector<Vec3>> lines;  // each of at least two points
};

struct ColouredGlb {
    std::string generator;
    std::string node;                         // of the mesh
    const TriangleMesh* mesh = nullptr;       // not null, with a triangle; owned by the caller
    std::span<const std::uint8_t> colour_of;  // per triangle, index in `colours`
    std::vector<GlbColour> colours;
    std::vector<GlbLines> lines;  // groups without a line are left out
};

Bytes to_glb(const ColouredGlb& scene);

}  // namespace qchopper
