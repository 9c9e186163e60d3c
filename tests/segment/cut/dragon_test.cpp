// A real scan of 871,306 faces with some two hundred pairs of faces that intersect. Its halves must be closed on every
// plane all the same.

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "segment/cut/cut.h"
#include "segment/cut/nudge.h"
#include "segment/import/import_scan.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/measure.h"
#include "tests/pieces.h"

namespace qchopper {
namespace {

TEST(CutDragon, BothHalvesAreClosedOnEveryPlane) {
    const std::filesystem::path file = std::filesystem::path(QCHOPPER_MESHES) / "dragon_vrip_871k.ply";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "skipped: the dragon is not here";
    ImportOptions options;
    options.mm_per_unit = 1000;
    const Piece dragon = piece_of(import_scan(file, options).mesh);
    const double whole = volume_mm3(*dragon.mesh);
    std::mt19937 random(8);
    for (int round = 0; round < 6; ++round) {
        const Vec3 n = random_normal(random);
        const Extent range = extent(*dragon.mesh, n);
        std::vector<double> wanted;
        for (int k = 1; k <= 6; ++k) wanted.push_back(range.low + range.size() * k / 7);
        for (const auto& nudged : nudge(dragon, n, wanted)) {
            ASSERT_TRUE(nudged);
            const auto halves = cut(*dragon.mesh, {n, nudged->offset}, 1);
            ASSERT_TRUE(halves);
            ASSERT_TRUE(edges(halves->above.mesh).faults.is_closed()) << round << " at " << nudged->offset;
            ASSERT_TRUE(edges(halves->below.mesh).faults.is_closed()) << round << " at " << nudged->offset;
            ASSERT_NEAR((volume_mm3(halves->above.mesh) + volume_mm3(halves->below.mesh)) / whole, 1, 1e-9);
        }
    }
}

}  // namespace
}  // namespace qchopper
