// Draws a piece as the replay of its program left it, coloured by its deviation from the piece as ordered, and by what
// its program gives up.
//
// PNG, deviation_picture_width x deviation_picture_height pixels: two opposite sides with a legend below. Same input,
// same bytes, whatever the number of threads (tests/app/pictures/deviation_picture_test.cpp).

#pragma once

#include <span>
#include <vector>

#include "base/files/file.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// One value (mm) per triangle: positive where foam stays, negative where the piece was cut into; and whether the
// program gives it up, empty: none. Preconditions: the mesh has a triangle, one value per triangle.
Bytes deviation_picture(const TriangleMesh& mesh, std::span<const float> deviation,
                        const std::vector<bool>& is_given_up = {});

}  // namespace qchopper
