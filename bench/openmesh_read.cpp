// OpenMesh's reader with its default traits and with double precision. MeshIO.hh must be included before the mesh.

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "bench/other_readers.h"

namespace qchopper::bench {
namespace {

struct Doubles : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};

template <class Traits>
std::size_t faces_read(const std::filesystem::path& file) {
    OpenMesh::TriMesh_ArrayKernelT<Traits> mesh;
    return OpenMesh::IO::read_mesh(mesh, file.string()) ? mesh.n_faces() : 0;
}

}  // namespace

std::size_t openmesh_read(const std::filesystem::path& file, bool doubles) {
    return doubles ? faces_read<Doubles>(file) : faces_read<OpenMesh::DefaultTraits>(file);
}

}  // namespace qchopper::bench
