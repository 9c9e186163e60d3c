// Which shells of a closed mesh lie inside which.
//
// Orientation does not matter: a point is inside a shell when a ray from it meets that shell an odd number of times
// (tests/segment/mesh/nesting_test.cpp).

#pragma once

#include <cstdint>
#include <vector>

#include "segment/mesh/shells.h"

namespace qchopper {

// Per shell, the shells around it in ascending order. With `asked` only for the shells that are marked in it; the
// others have none.
std::vector<std::vector<std::uint32_t>> shells_around(const TriangleMesh& mesh, const Shells& shells,
                                                      const std::vector<bool>& asked = {});

}  // namespace qchopper
