// A painted copy of a scan is brought to the place of the imported one, and checked to be of the same surface.
//
// Lengths in mm (tests/app/store/ignored_surface_test.cpp, no_cut_surface_test.cpp).

#pragma once

#include <string>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// To millimetres about the centre of the scan: `factor` mm are one unit of the file.
void place_on_scan(TriangleMesh& painted, double factor, Vec3 centre);

// Throws InputError (mesh) if more than a hundredth of the area of `painted` is farther from the scan than half a
// hundredth of the scan's diagonal. `name` stands for the file.
void check_is_of_scan(const TriangleMesh& painted, const TriangleMesh& scan, const std::string& name);

}  // namespace qchopper
