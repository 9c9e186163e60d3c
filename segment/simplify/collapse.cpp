// Edges by ascending quadric error: M. Garland and P. Heckbert, "Surface simplification using quadric error metrics"
// (1997), in the implementation of OpenMesh: M. Botsch, S. Steinberg, S. Bischoff and L. Kobbelt, "OpenMesh - a generic
// and efficient polygon mesh data structure" (2002). O(n log n) for n faces; a half-edge mesh of it in memory.

#include "segment/simplify/collapse.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModHausdorffT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <OpenMesh/Tools/Decimater/Observer.hh>

#include <algorithm>
#include <array>
#include <mutex>

#include "segment/simplify/sound_face.h"

namespace qchopper {
namespace {

struct CollapseTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
    HalfedgeAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::PrevHalfedge);
};
using Surface = OpenMesh::TriMesh_ArrayKernelT<CollapseTraits>;

Vec3 vec3(const OpenMesh::Vec3d& p) {
    return {p[0], p[1], p[2]};
}

template <class MeshT>
class KeepSound : public OpenMesh::Decimater::ModBaseT<MeshT> {
 public:
    DECIMATING_MODULE(KeepSound, MeshT, Sound);

    explicit KeepSound(MeshT& mesh) : Base(mesh, true) {}

    float collapse_priority(const CollapseInfo& info) override {
        const MeshT& mesh = Base::mesh();
        for (auto face = mesh.cvf_iter(info.v0); face.is_valid(); ++face) {
            if (*face == info.fl || *face == info.fr) continue;
            std::array<Vec3, 3> before;
            std::array<Vec3, 3> after;
            std::size_t i = 0;
            for (auto corner = mesh.cfv_iter(*face); corner.is_valid(); ++corner, ++i) {
                before[i] = vec3(mesh.point(*corner));
                after[i] = *corner == info.v0 ? vec3(info.p1) : before[i];
            }
            if (!is_sound_change(before, after)) return Base::ILLEGAL_COLLAPSE;
        }
        return Base::LEGAL_COLLAPSE;
    }
};

class Reporter : public OpenMesh::Decimater::Observer {
 public:
    Reporter(const Context& context, std::size_t points) : Observer(1000), context_(context), points_(points) {}
    void notify(std::size_t step) override { context_.progress("points removed", step, points_); }
    bool abort() const override { return context_.cancelled != nullptr && context_.cancelled->load(); }

 private:
    const Context& context_;
    std::size_t points_;
};

bool build(const TriangleMesh& mesh, const std::vector<std::uint8_t>& is_locked, Surface& surface) {
    static std::once_flag is_quiet;
    std::call_once(is_quiet, [] { omerr().disable(); });  // it would print what the result states
    surface.reserve(mesh.points.size(), 3 * mesh.triangles.size() / 2 + 1, mesh.triangles.size());
    for (const Vec3& p : mesh.points) surface.add_vertex({p.x, p.y, p.z});
    for (const Triangle& t : mesh.triangles) {
        const auto corner = [&](std::size_t i) { return surface.vertex_handle(t[i]); };
        if (!surface.add_face(corner(0), corner(1), corner(2)).is_valid()) return false;
    }
    for (std::size_t i = 0; i < is_locked.size(); ++i) {
        if (is_locked[i] != 0) surface.status(surface.vertex_handle(static_cast<unsigned>(i))).set_locked(true);
    }
    return true;
}

// A collapse replaces a corner of the faces around. Each face begins with the corner that it began with, if it has that
// still.
TriangleMesh result_of(const Surface& surface, const TriangleMesh& mesh) {
    TriangleMesh result;
    std::vector<std::uint32_t> number(mesh.points.size(), 0);
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        const auto vertex = surface.vertex_handle(static_cast<unsigned>(i));
        if (surface.status(vertex).deleted() || surface.is_isolated(vertex)) continue;
        number[i] = static_cast<std::uint32_t>(result.points.size());
        result.points.push_back(mesh.points[i]);
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto face = surface.face_handle(static_cast<unsigned>(t));
        if (surface.status(face).deleted()) continue;
        Triangle corners{};
        std::size_t i = 0;
        for (auto corner = surface.cfv_iter(face); corner.is_valid(); ++corner, ++i) {
            corners[i] = static_cast<std::uint32_t>(corner->idx());
        }
        const auto first = std::find(corners.begin(), corners.end(), mesh.triangles[t][0]);
        if (first != corners.end()) std::rotate(corners.begin(), first, corners.end());
        result.triangles.push_back({number[corners[0]], number[corners[1]], number[corners[2]]});
        if (!mesh.cap_of.empty()) result.cap_of.push_back(mesh.cap_of[t]);
    }
    return result;
}

}  // namespace

bool collapse_edges(TriangleMesh& mesh, const std::vector<std::uint8_t>& is_locked, const CollapseLimits& limits,
                    const Context& context) {
    Surface surface;
    if (!build(mesh, is_locked, surface)) return false;
    using namespace OpenMesh::Decimater;
    DecimaterT<Surface> decimater(surface);
    typename ModQuadricT<Surface>::Handle quadric;
    typename KeepSound<Surface>::Handle sound;
    typename ModHausdorffT<Surface>::Handle close;
    decimater.add(quadric);
    decimater.add(sound);
    if (limits.distance) {
        const double error = limits.planes * *limits.distance;
        decimater.module(quadric).set_max_err(error * error, false);
        decimater.add(close);
        decimater.module(close).set_tolerance(*limits.distance);
    } else {
        decimater.module(quadric).unset_max_err();
    }
    if (!decimater.initialize()) return false;
    Reporter reporter(context, mesh.points.size());
    decimater.set_observer(&reporter);
    decimater.decimate_to_faces(0, limits.max_faces);
    context.check_cancelled();
    mesh = result_of(surface, mesh);
    return true;
}

}  // namespace qchopper
