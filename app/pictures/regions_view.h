// The regions into which a method of the literature divides the scan of a project (segment/regions), as a picture or a
// mesh, and the planes along their borders. Changes nothing.

#pragma once

#include <filesystem>
#include <string>

#include "base/context.h"
#include "segment/regions/region_planes.h"

namespace qchopper {

struct RegionMethod;

struct RegionsRequest {
    std::string method;          // a name of region_methods() (segment/regions/methods.h)
    std::filesystem::path file;  // .png: a picture from two sides; .ply: the scan with `region` and a colour per face
};

struct ShownRegions {
    std::string method;
    std::size_t regions = 0;
    std::size_t copy_faces = 0;  // triangles of the simplified copy that was divided
    RegionPlanes planes;
    std::filesystem::path file;  // that was written
};

// "shlafman finds 7 regions and proposes 6 planes along their borders."
std::string region_sentence(const std::string& method, std::size_t regions, const RegionPlanes& found);

// Regions that touch have different colours. Precondition: the method has such a name. Throws InputError (use) for
// another ending, what write_file throws, and Cancelled.
ShownRegions show_regions(const TriangleMesh& scan, const RegionsRequest& request, const Context& context);

}  // namespace qchopper
