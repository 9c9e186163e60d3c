// O(triangles * half-spaces).

#include "bench/job_piece.h"

#include <algorithm>
#include <cmath>

#include "app/jobs/job_proof.h"

namespace qchopper::bench {

TriangleMesh mesh_of(const ReadJob& job) {
    constexpr double near = 1e-3;
    TriangleMesh mesh = job_mesh(job.files.at("piece.stl"), job.piece);
    mesh.cap_of.assign(mesh.triangles.size(), no_cap);
    for (const HalfSpace& half_space : job.half_spaces) {
        const Vec3 point = apply(job.setup.piece_in_setup, half_space.plane.offset * half_space.plane.normal);
        const Vec3 normal = rotate(job.setup.piece_in_setup, half_space.plane.normal);
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const auto corners = corners_of(mesh, t);
            const auto is_in_plane = [&](Vec3 p) { return std::abs(dot(p - point, normal)) <= near; };
            if (std::all_of(corners.begin(), corners.end(), is_in_plane)) mesh.cap_of[t] = half_space.cut;
        }
    }
    return mesh;
}

}  // namespace qchopper::bench
