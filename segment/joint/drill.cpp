// A cap with holes is triangulated anew between its old outlines and those of the holes, with the points that are
// there: so its neighbours stay joined to it. Walls and bottoms are added.

#include "segment/joint/drill.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "segment/cut/cap.h"
#include "segment/joint/flat_region.h"
#include "segment/mesh/plane_frame.h"
#include "segment/mesh/submesh.h"

namespace qchopper {
namespace {

std::vector<Dowel> dowels_in(std::size_t piece, std::int32_t cut, std::span<const PieceJoint> joints) {
    std::vector<Dowel> dowels;
    for (const PieceJoint& joint : joints) {
        if (joint.cut != cut || (joint.below != piece && joint.above != piece)) continue;
        dowels.insert(dowels.end(), joint.dowels.begin(), joint.dowels.end());
    }
    return dowels;
}

// The corners on the cap, counter-clockwise seen against the normal.
std::vector<Vec3> rim(const Dowel& dowel, const PlaneFrame& frame) {
    std::vector<Vec3> corners;
    for (std::size_t i = 0; i < hole_sides; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / hole_sides;
        corners.push_back(dowel.point + dowel.size.radius() * (std::cos(angle) * frame.u + std::sin(angle) * frame.v));
    }
    return corners;
}

void add(TriangleMesh& mesh, Triangle triangle, bool is_turned, std::int32_t cap) {
    if (is_turned) std::swap(triangle[1], triangle[2]);
    mesh.triangles.push_back(triangle);
    if (!mesh.cap_of.empty()) mesh.cap_of.push_back(cap);
    if (!mesh.ignored.empty()) mesh.ignored.push_back(0);
}

// Drills from a cap. The surface of the cap faces along the plane's normal where the piece lies below, and everything
// is written for that; otherwise triangles are turned.
class CapDrill {
 public:
    CapDrill(TriangleMesh& mesh, const HalfSpace& half_space) : mesh_(mesh), half_space_(half_space) {}

    void drill(const std::vector<Dowel>& dowels) {
        collect_cap();
        for (const Dowel& dowel : dowels) add_hole(dowel);
        std::vector<bool> is_kept(mesh_.triangles.size());
        for (std::size_t t = 0; t < is_kept.size(); ++t) is_kept[t] = cap_of(mesh_, t) != half_space_.cut;
        keep_triangles(mesh_, is_kept);
        for (const auto& t : triangulate_regions(points_, loops_, nest_polygons(points_, loops_)).triangles) {
            add(mesh_, {number_[t[0]], number_[t[1]], number_[t[2]]}, half_space_.above, half_space_.cut);
        }
        for (const Tube& tube : tubes_) add_tube(tube);
    }

 private:
    struct Tube {
        std::uint32_t top = 0;     // first point of the rim on the cap
        std::uint32_t bottom = 0;  // of that at the depth
    };

    void collect_cap() {
        FlatPolygons flat;
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            if (cap_of(mesh_, t) != half_space_.cut) continue;
            const Triangle& c = mesh_.triangles[t];
            if (half_space_.above) {
                flat.polygons.push_back({c[0], c[2], c[1]});
            } else {
                flat.polygons.push_back({c[0], c[1], c[2]});
            }
        }
        for (const Loop& outline : outlines(flat)) {
            Loop loop;
            for (const std::uint32_t p : outline) loop.push_back(add_point(p));
            loops_.push_back(std::move(loop));
        }
    }

    std::uint32_t add_point(std::uint32_t of_mesh) {
        number_.push_back(of_mesh);
        points_.push_back(on_plane(half_space_.plane, mesh_.points[of_mesh]));
        return static_cast<std::uint32_t>(points_.size()) - 1;
    }

    void add_hole(const Dowel& dowel) {
        const PlaneFrame frame = frame_across(half_space_.plane.normal);
        const Vec3 depth = dowel.size.depth * half_space_.up();
        Tube tube{static_cast<std::uint32_t>(mesh_.points.size()), 0};
        const std::vector<Vec3> corners = rim(dowel, frame);
        mesh_.points.insert(mesh_.points.end(), corners.begin(), corners.end());
        tube.bottom = static_cast<std::uint32_t>(mesh_.points.size());
        for (const Vec3& p : corners) mesh_.points.push_back(p + depth);
        tubes_.push_back(tube);
        Loop loop;
        for (std::uint32_t i = hole_sides; i-- > 0;) loop.push_back(add_point(tube.top + i));
        loops_.push_back(std::move(loop));
    }

    void add_tube(const Tube& tube) {
        const auto sides = static_cast<std::uint32_t>(hole_sides);
        for (std::uint32_t i = 0; i < sides; ++i) {
            const std::uint32_t k = (i + 1) % sides;
            add(mesh_, {tube.top + i, tube.top + k, tube.bottom + k}, half_space_.above, no_cap);
            add(mesh_, {tube.top + i, tube.bottom + k, tube.bottom + i}, half_space_.above, no_cap);
        }
        for (std::uint32_t i = 1; i + 1 < sides; ++i) {
            add(mesh_, {tube.bottom, tube.bottom + i, tube.bottom + i + 1}, half_space_.above, no_cap);
        }
    }

    TriangleMesh& mesh_;
    const HalfSpace& half_space_;
    std::vector<Point2> points_;         // of the loops
    std::vector<std::uint32_t> number_;  // of each of them in the mesh
    std::vector<Loop> loops_;
    std::vector<Tube> tubes_;
};

}  // namespace

TriangleMesh drilled(const Piece& piece, std::size_t index, std::span<const PieceJoint> joints) {
    TriangleMesh mesh = *piece.mesh;
    for (const HalfSpace& half_space : piece.half_spaces) {
        const std::vector<Dowel> dowels = dowels_in(index, half_space.cut, joints);
        if (!dowels.empty()) CapDrill(mesh, half_space).drill(dowels);
    }
    return mesh;
}

}  // namespace qchopper
