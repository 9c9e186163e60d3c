// Draws a piece as the replay of its program left it, coloured by its deviation from the piece as ordered, and by what
// its program gives up.
//
// PNG, deviation_picture_width x deviation_picture_height pixels: two opposite sides with a legend below. Same input,
// same bytes, whatever the number of threads (tests/app/pictures/deviation_picture_test.cpp).

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/files/file.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// The number of the colour of each triangle, as the picture has them: from the deepest gouge to most foam, the last one
// is of what is given up. Arguments as of deviation_picture.
std::vector<std::uint8_t> deviation_classes(std::span<const float> deviation, const std::vector<bool>& is_given_up);

// One value (mm) per triangle: positive where foam stays, negative where the piece was cut into; and whether the
// program gives it up, empty: none. Preconditions: the mesh has a triangle, one value per triangle.
Bytes deviation_picture(const TriangleMesh& mesh, std::span<const float> deviation,
                        const std::vector<bool>& is_given_up = {});

}  // namespace qchopper
