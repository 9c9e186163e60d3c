// The names of the formats, as a table.

#include "segment/io/formats/raw_mesh.h"

#include <array>

namespace qchopper {

std::string name_of(MeshFormat format) {
    constexpr std::array names{"PLY, ASCII",
                               "PLY, binary little-endian",
                               "PLY, binary big-endian",
                               "STL, ASCII",
                               "STL, binary",
                               "OBJ",
                               "OFF",
                               "glTF",
                               "GLB",
                               "3MF"};  // in the order of MeshFormat
    static_assert(names.size() == static_cast<std::size_t>(MeshFormat::three_mf) + 1);
    return names.at(static_cast<std::size_t>(format));
}

}  // namespace qchopper
