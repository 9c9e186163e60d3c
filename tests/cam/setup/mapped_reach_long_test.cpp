// Height fields of real scans against rays.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "base/error.h"
#include "segment/import/import_scan.h"
#include "tests/cam/setup/ray_areas.h"
#include "tests/real_scans.h"

namespace qchopper {
namespace {

TEST(MappedAccessLong, ReachesTheAreaThatRaysReachOnEveryValidScan) {
    const std::vector<RealScan> scans = valid_scans(QCHOPPER_MESHES, 400'000);
    if (!std::filesystem::exists(QCHOPPER_MESHES)) GTEST_SKIP() << "skipped: the real meshes are not here";
    std::size_t taken = 0;
    for (const RealScan& scan : scans) {
        ImportedScan imported;
        try {
            ImportOptions options;
            options.mm_per_unit = 100;
            imported = import_scan(std::filesystem::path(QCHOPPER_MESHES) / scan.file, options);
        } catch (const InputError&) {
            continue;  // no valid mesh: import refuses it
        }
        ++taken;
        const Vec3 size = bounds(imported.mesh).size();
        const double longest = std::max({size.x, size.y, size.z});
        const TriangleMesh mesh = test_pieces::with_short_edges(imported.mesh, longest / 100);
        std::cout << scan.file << "\n";
        for (const Vec3 d :
             {Vec3{0, 0, 1}, Vec3{1, 0, 0}, normalized({0.3, -0.5, 0.8}), normalized({-0.7, 0.2, -0.4})}) {
            test_pieces::expect_rays_agree(mesh, d, longest / 1500);
        }
    }
    EXPECT_GE(taken, 5U);
}

}  // namespace
}  // namespace qchopper
