// Reads one model file of a 3MF package as it stands: objects, and where the build places them.
//
// The XML is read part by part, so that its text is never in memory whole. The corners of triangles are checked here;
// references between objects are not (read_3mf.h resolves them). Lengths are in the unit of the model.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "segment/io/formats/placement.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// A placed object: a component of another one, or an item of the build.
struct Reference3mf {
    std::string path;  // of the model file that holds it; empty: this one
    std::uint32_t object = 0;
    Placement placement;
};

struct Object3mf {
    std::uint32_t id = 0;
    std::string type = "model";       // or support, solidsupport, surface, other
    std::vector<Vec3> points;         // finite
    std::vector<Triangle> triangles;  // corners are indices of points
    std::vector<Reference3mf> components;
    bool has_beams = false;  // a beam lattice, which makes no triangles
};

struct Model3mf {
    double mm_per_unit = 1;
    std::vector<Object3mf> objects;  // by ascending id, each id once
    std::vector<Reference3mf> items;
};

// Writes at most `size` bytes to `to` and returns their number; 0 at the end.
using ReadSome = std::function<std::size_t(char* to, std::size_t size)>;

// Throws InputError (mesh) for XML that is damaged or is no such model, with the line; `name` stands for the file.
// Exceptions of read_some pass through.
Model3mf read_model_3mf(const ReadSome& read_some, const std::string& name);

// The path of the first model file, from the relations of a package (_rels/.rels); empty if they name none. Throws as
// read_model_3mf does.
std::string start_part_3mf(const ReadSome& read_some, const std::string& name);

}  // namespace qchopper
