#include "app/display/exact_faces.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>

#include "base/parallel.h"
#include "segment/mesh/triangle_tree.h"
#include "segment/simplify/simplify.h"
#include "segment/simplify/vertex_clustering.h"
#include "tests/app/display/cut_shapes.h"

namespace qchopper {
namespace {

double angle_cosine(Vec3 a, Vec3 b) {
    return dot(normalized(a), normalized(b));
}

std::array<Vec3, 3> corners_in_mm(const DisplayMesh& mesh, const Triangle& t) {
    return {place(mesh.grid, mesh.points[t[0]]), place(mesh.grid, mesh.points[t[1]]),
            place(mesh.grid, mesh.points[t[2]])};
}

// Least distance from the middle of a face to the triangles of the piece for which is_asked holds.
template <class Asked>
double distance_by_force(const std::array<Vec3, 3>& face, const TriangleMesh& piece, const Asked& is_asked) {
    const Vec3 middle = 1.0 / 3 * (face[0] + face[1] + face[2]);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < piece.triangles.size(); ++t) {
        if (!is_asked(t)) continue;
        nearest = std::min(nearest, norm(closest_on_triangle(middle, corners_of(piece, t)) - middle));
    }
    return nearest;
}

bool has_same_corners(const DisplayMesh& shown, const Triangle& face, const TriangleMesh& piece, std::size_t t) {
    const std::array<Vec3, 3> corners = corners_of(piece, t);
    for (std::size_t turn = 0; turn < 3; ++turn) {
        bool is_same = true;
        for (std::size_t k = 0; k < 3; ++k) {
            is_same = is_same && nearest_point(shown.grid, corners[(k + turn) % 3]) == shown.points[face[k]];
        }
        if (is_same) return true;
    }
    return false;
}

// Against every triangle of the piece.
void expect_found(const DisplayMesh& shown, const TriangleMesh& piece, std::size_t& by_distance) {
    const std::vector<std::uint32_t> found = exact_faces(shown, piece);
    ASSERT_EQ(found.size(), shown.triangles.size());
    for (const DisplayGroup& group : shown.groups) {
        for (std::uint32_t t = group.first; t < group.first + group.faces; ++t) {
            ASSERT_LT(found[t], piece.triangles.size());
            std::size_t same = 0;
            while (same < piece.triangles.size() &&
                   !(cap_of(piece, same) == group.cut && has_same_corners(shown, shown.triangles[t], piece, same))) {
                ++same;
            }
            if (same < piece.triangles.size()) {
                EXPECT_EQ(found[t], same);
                continue;
            }
            ++by_distance;
            EXPECT_EQ(group.cut, no_cap) << "caps have the same triangles";
            const std::array<Vec3, 3> face = corners_in_mm(shown, shown.triangles[t]);
            const Vec3 normal = cross(face[1] - face[0], face[2] - face[0]);
            const auto is_skin = [&](std::size_t k) { return cap_of(piece, k) == no_cap; };
            const auto is_alike = [&](std::size_t k) {
                return is_skin(k) && angle_cosine(normal, area_vector(piece, k)) >= 0.5;
            };
            const double any = distance_by_force(face, piece, is_skin);
            const double alike = distance_by_force(face, piece, is_alike);
            const double own = distance_by_force(face, piece, [&](std::size_t k) { return k == found[t]; });
            const bool is_near = alike <= 8 * (any + shown.grid.step);
            EXPECT_NEAR(own, is_near ? alike : any, 1e-9 * (1 + own));
            EXPECT_TRUE(!is_near || is_alike(found[t]));
        }
    }
}

TEST(ExactFaces, AreThoseOfABruteForceForSimplifiedParts) {
    std::size_t by_distance = 0;
    for (const shapes::Named& shape : awkward_shapes()) {
        for (const TriangleMesh& part : parts_of(shape.mesh)) {
            TriangleMesh fewer = part;
            SimplifyOptions options;
            options.max_faces = std::max<std::size_t>(4, part.triangles.size() / 3);
            options.is_quick = true;
            simplify(fewer, options);
            expect_found(display_mesh(fewer, display_grid(bounds(shape.mesh))), part, by_distance);
        }
    }
    EXPECT_GT(by_distance, 300U) << "else hardly any face was searched";
}

TEST(ExactFaces, AreThoseOfABruteForceForAClusteredMesh) {
    std::size_t by_distance = 0;
    const TriangleMesh torus = bumpy_torus(45);
    expect_found(display_mesh(cluster_to(500, torus).mesh, display_grid(bounds(torus))), torus, by_distance);
    EXPECT_GT(by_distance, 300U);
}

// The two sides of a plate of 0.02 mm: the grid has steps of 0.006 mm, and the side that is turned away is nearer.
TEST(ExactFaces, TheOtherSideOfAThinPlateIsNotTaken) {
    const TriangleMesh plate = shapes::box({0, 0, 0}, {100, 100, 0.02}, 8);
    const TriangleMesh coarse = shapes::box({0, 0, 0.015}, {100, 100, 0.022}, 1);
    const DisplayMesh shown = display_mesh(coarse, display_grid(bounds(plate)));
    const std::vector<std::uint32_t> found = exact_faces(shown, plate);
    std::size_t below = 0;
    for (std::size_t t = 0; t < found.size(); ++t) {
        const std::array<Vec3, 3> face = corners_in_mm(shown, shown.triangles[t]);
        const Vec3 normal = normalized(cross(face[1] - face[0], face[2] - face[0]));
        if (std::abs(normal.z) < 0.9) continue;
        EXPECT_GT(dot(normal, area_vector(plate, found[t])), 0);
        below += normal.z < 0 ? 1 : 0;
    }
    EXPECT_EQ(below, 2U);
}

TEST(ExactFaces, AnyNumberOfThreadsGivesTheSame) {
    const TriangleMesh torus = bumpy_torus(64);
    const DisplayMesh shown = display_mesh(cluster_to(1'500, torus).mesh, display_grid(bounds(torus)));
    const std::vector<std::uint32_t> expected = exact_faces(shown, torus);
    for (const std::size_t threads : {1, 2}) {
        const ThreadLimit limit(threads);
        EXPECT_EQ(exact_faces(shown, torus), expected);
    }
}

TEST(ExactFaces, NothingShownIsNothingAsked) {
    EXPECT_TRUE(exact_faces({}, {}).empty());
}

TEST(ExactFaces, ItIsCancelled) {
    const std::atomic<bool> cancelled{true};
    Context context;
    context.cancelled = &cancelled;
    const TriangleMesh torus = bumpy_torus(45);
    const DisplayMesh shown = display_mesh(cluster_to(500, torus).mesh, display_grid(bounds(torus)));
    EXPECT_THROW(exact_faces(shown, torus, context), Cancelled);
}

}  // namespace
}  // namespace qchopper
