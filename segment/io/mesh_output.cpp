// Two formats; O(faces).

#include "segment/io/mesh_output.h"

#include "base/files/file.h"
#include "segment/io/write_ply.h"
#include "segment/io/write_stl.h"

namespace qchopper {

void check_mesh_name(const std::filesystem::path& file) {
    if (file.extension() == ".stl" || file.extension() == ".ply") return;
    throw InputError(InputFault::use, file.string() + " ends neither in .ply nor in .stl", "name a .ply file");
}

void write_mesh(const std::filesystem::path& file, const TriangleMesh& mesh) {
    check_mesh_name(file);
    write_file(file, file.extension() == ".stl" ? to_stl(mesh) : to_ply(mesh));
}

}  // namespace qchopper
