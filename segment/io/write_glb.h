// Writes meshes as GLB (glTF 2.0, binary) for any viewer: one node each, under a root node that converts mm to metres.
//
// glTF has metres and Y up: the root node rotates and scales; the numbers are millimetres with Z up, in single
// precision about the origin of the node. Caps are a second primitive with a material of their own. The same scene
// gives the same bytes (tests/segment/io/write_glb_test.cpp).

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/files/file.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

using GlbNote = std::pair<std::string, std::variant<bool, int, double, std::string>>;

// Where a node is at a time, beside its place: linear between keys.
struct GlbKey {
    double time_s = 0;
    Vec3 shift;  // mm
};

struct GlbNode {
    std::string name;                                 // "piece/B"
    const TriangleMesh* mesh = nullptr;               // not null, about the origin of the node; owned by the caller
    Vec3 origin;                                      // of the node, mm
    std::array<double, 3> surface{0.80, 0.72, 0.56};  // linear red, green, blue
    std::array<double, 3> cap{0.90, 0.85, 0.74};
    std::vector<GlbNote> notes;     // extras: {"qchopper": {...}}
    std::vector<GlbKey> keys = {};  // of the animation, times ascending; empty: the node stays
};

struct GlbScene {
    std::string generator;
    std::string root = "scene";  // name of the root node
    std::vector<GlbNode> nodes;
    std::string animation = "assembly";  // its name; there is one where a node has keys
};

// Throws InputError (use) for a scene beyond the 4 GiB that the format can hold.
Bytes to_glb(const GlbScene& scene);

}  // namespace qchopper
