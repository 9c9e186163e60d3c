#include "segment/access/cap_outline.h"

#include <gtest/gtest.h>

#include "segment/mesh/plane.h"
#include "tests/segment/access/sampled_pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// Area of the part of a triangle that lies below a plane, by clipping it.
double clipped_area(const std::array<Vec3, 3>& corners, const Plane& plane) {
    std::vector<Vec3> kept;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 a = corners[k];
        const Vec3 b = corners[(k + 1) % 3];
        const double of_a = height(plane.normal, a) - plane.offset;
        const double of_b = height(plane.normal, b) - plane.offset;
        if (of_a < 0) kept.push_back(a);
        if ((of_a < 0) != (of_b < 0)) kept.push_back(a + (of_a / (of_a - of_b)) * (b - a));
    }
    Vec3 sum{};
    for (std::size_t k = 2; k < kept.size(); ++k) sum = sum + cross(kept[k - 1] - kept[0], kept[k] - kept[0]);
    return norm(sum) / 2;
}

TEST(CapOutline, TheAreaBelowAPlaneIsThatOfTheClippedCap) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    std::size_t caps = 0;
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        Piece piece = pieces_of_solids(mesh).front();
        for (const Vec3 n : {Vec3{0.1, 0.9, 0.2}, Vec3{0.8, -0.3, 0.4}}) {
            const Vec3 across = canonical({normalized(n), 0}).normal;
            const Extent range = extent(*piece.mesh, across);
            const auto nudged = nudge(piece, across, std::array{range.low + 0.45 * range.size()});
            if (!nudged[0]) continue;
            const auto made = cut_piece(piece, {across, nudged[0]->offset}, static_cast<std::int32_t>(++caps));
            if (made) piece = made->pieces.front();
        }
        const std::vector<OwnedCap> owned = owned_caps(piece);
        const std::vector<CapOutline> all = outlines(*piece.mesh, owned);
        ASSERT_EQ(all.size(), owned.size());
        for (int i = 0; i < 20; ++i) {
            const Vec3 direction = normalized(Vec3{normal(random), normal(random), normal(random)});
            const Extent range = extent(*piece.mesh, direction);
            std::vector<double> offsets;
            for (int k = -1; k < 12; ++k) offsets.push_back(range.low + range.size() * k / 10.3);
            for (const CapOutline& cap : all) {
                const std::vector<double> areas = cap.area_below(direction, offsets);
                for (std::size_t j = 0; j < offsets.size(); ++j) {
                    double expected = 0;
                    for (std::size_t t = 0; t < piece.mesh->triangles.size(); ++t) {
                        if (cap_of(*piece.mesh, t) != cap.cap().cut) continue;
                        expected += clipped_area(corners_of(*piece.mesh, t), {direction, offsets[j]});
                    }
                    EXPECT_NEAR(areas[j], expected, 1e-6 * cap.cap().area_mm2) << name;
                }
            }
        }
    }
    EXPECT_GT(caps, 5U);
}

}  // namespace
}  // namespace qchopper
