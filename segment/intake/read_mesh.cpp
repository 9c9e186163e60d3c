#include "segment/intake/read_mesh.h"

#include "segment/error.h"
#include "segment/intake/read_ply.h"
#include "segment/intake/read_stl.h"

namespace qchopper {
namespace {

RawMesh parse_by_content(const Bytes& bytes, const std::string& name) {
    if (bytes.empty()) throw InputError(InputFault::mesh, name + " is empty", "export or copy the file again");
    if (is_ply(bytes)) return parse_ply(bytes, name);
    if (is_binary_stl(bytes)) return parse_binary_stl(bytes, name);
    if (is_ascii_stl(bytes)) return parse_ascii_stl(bytes, name);
    throw InputError(InputFault::mesh,
                     name + " is no PLY, no ASCII STL and no whole binary STL: it begins with neither \"ply\" nor " +
                         "\"solid\", and " + why_no_binary_stl(bytes),
                     "give a PLY or STL file; if it was one, export or copy it again");
}

}  // namespace

std::string name_of(MeshFormat format) {
    switch (format) {
        case MeshFormat::ply_ascii:
            return "PLY, ASCII";
        case MeshFormat::ply_little_endian:
            return "PLY, binary little-endian";
        case MeshFormat::ply_big_endian:
            return "PLY, binary big-endian";
        case MeshFormat::stl_ascii:
            return "STL, ASCII";
        case MeshFormat::stl_binary:
            break;
    }
    return "STL, binary";
}

RawMesh parse_mesh(const Bytes& bytes, const std::string& name) {
    RawMesh scan = parse_by_content(bytes, name);
    if (scan.mesh.triangles.empty()) {
        throw InputError(InputFault::mesh, name + " holds no faces", "export the scan as a surface, not as points");
    }
    return scan;
}

RawMesh read_mesh(const std::filesystem::path& path) {
    return parse_mesh(read_file(path), path.string());
}

}  // namespace qchopper
