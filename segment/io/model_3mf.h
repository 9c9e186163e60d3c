// One model file of a 3MF package as it stands there: objects and what is to be built of them.
//
// Its XML comes in stretches, so that no text of it ever lies in memory whole. Indices are checked here; references
// between objects are not (read_3mf.h follows them).

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "segment/io/placement.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// An object somewhere: a component of another one, or an item of the build.
struct Reference3mf {
    std::string path;  // of the model file that holds it; empty: this one
    std::uint32_t object = 0;
    Placement placement;
};

struct Object3mf {
    std::uint32_t id = 0;
    std::string type = "model";  // or support, solidsupport, surface, other
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    std::vector<Reference3mf> components;
    bool has_beams = false;  // a lattice, which makes no faces
};

struct Model3mf {
    double mm_per_unit = 1;
    std::vector<Object3mf> objects;  // in the order of their ids
    std::vector<Reference3mf> items;
};

// Returns how many bytes it has put there; 0 at the end.
using ReadSome = std::function<std::size_t(char* to, std::size_t room)>;

// `name` stands for the file in errors. Throws InputError (mesh) for XML that is damaged or no model, with the line.
Model3mf read_model_3mf(const ReadSome& read_some, const std::string& name);

// The path of the model file, as the relations of a package (_rels/.rels) name it; empty if they do not.
std::string start_part_3mf(const ReadSome& read_some, const std::string& name);

}  // namespace qchopper
