// The names of the formats, as a table.

#include "segment/io/raw_mesh.h"

#include <array>

namespace qchopper {

std::string name_of(MeshFormat format) {
    constexpr std::array<const char*, 10> names{"PLY, ASCII",
                                                "PLY, binary little-endian",
                                                "PLY, binary big-endian",
                                                "STL, ASCII",
                                                "STL, binary",
                                                "OBJ",
                                                "OFF",
                                                "glTF",
                                                "GLB",
                                                "3MF"};  // in the order of MeshFormat
    return names.at(static_cast<std::size_t>(format));
}

}  // namespace qchopper
