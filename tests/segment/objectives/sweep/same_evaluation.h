// Compares the sweep with cutting: the same pieces, faces and bases exactly, the same sums to 1e-9.

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "segment/cut/nudge.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/oriented_box.h"
#include "segment/objectives/sweep/sweep.h"
#include "tests/reference/segment/objectives/evaluate_by_cutting.h"

namespace qchopper {

// The two evaluations list solids in different orders.
inline std::vector<SolidEvaluation> sorted(std::vector<SolidEvaluation> solids) {
    std::sort(solids.begin(), solids.end(), [](const SolidEvaluation& a, const SolidEvaluation& b) {
        return std::tuple(a.above, a.faces, a.volume_mm3) < std::tuple(b.above, b.faces, b.volume_mm3);
    });
    return solids;
}

inline void expect_equal(const CutEvaluation& fast, const CutEvaluation& plain, double size, bool by_area,
                         const std::string& what) {
    const double area = size * size;
    EXPECT_NEAR(fast.cap_area_mm2, plain.cap_area_mm2, 1e-9 * plain.cap_area_mm2 + 1e-13 * area) << what;
    EXPECT_NEAR(fast.fragility, plain.fragility, 1e-9 * (1 + plain.fragility) + 1e-13 * area / plain.cap_area_mm2)
        << what;
    EXPECT_NEAR(fast.seam_mm, plain.seam_mm, 1e-9 * plain.seam_mm + 1e-12 * size) << what;
    ASSERT_EQ(fast.solids.size(), plain.solids.size()) << what;
    const auto a = sorted(fast.solids);
    const auto b = sorted(plain.solids);
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_EQ(a[i].above, b[i].above) << what;
        ASSERT_EQ(a[i].faces, b[i].faces) << what;
        ASSERT_NEAR(a[i].volume_mm3, b[i].volume_mm3, 1e-9 * std::abs(b[i].volume_mm3) + 1e-12 * area * size) << what;
        ASSERT_NEAR(norm(a[i].size - b[i].size), 0, 1e-9 * size) << what;
        ASSERT_EQ(a[i].bases.size(), b[i].bases.size()) << what;
        for (std::size_t k = 0; k < a[i].bases.size(); ++k) {
            ASSERT_EQ(a[i].bases[k].cut, b[i].bases[k].cut) << what;
            if (by_area)
                ASSERT_NEAR(a[i].bases[k].all_mm2, b[i].bases[k].all_mm2, 1e-9 * b[i].bases[k].all_mm2 + 1e-12 * area)
                    << what;
            else
                ASSERT_NEAR(a[i].bases[k].all_count, b[i].bases[k].all_count, 1e-9 * b[i].bases[k].all_count) << what;
            ASSERT_NEAR(undercut(a[i].bases[k], by_area), undercut(b[i].bases[k], by_area), 1e-9) << what;
        }
    }
}

// Evaluates every offset of a normal by the sweep and by cutting. Returns the number of offsets compared.
inline std::size_t expect_same(const Piece& piece, Vec3 normal, std::vector<double> wanted,
                               const Objectives& objectives, const std::string& what) {
    std::sort(wanted.begin(), wanted.end());
    std::vector<double> offsets;
    for (const auto& n : nudge(piece, normal, wanted)) {
        if (n && (offsets.empty() || n->offset > offsets.back())) offsets.push_back(n->offset);
    }
    if (offsets.empty()) return 0;
    const auto axes = objectives.needs_sizes() ? oriented_box(piece.mesh->points).axis : std::array<Vec3, 3>{};
    const auto fast = sweep(prepare(piece, objectives, &axes), normal, offsets, objectives);
    const double size = norm(bounds(*piece.mesh).size());
    for (std::size_t j = 0; j < offsets.size(); ++j) {
        const auto plain = evaluate_by_cutting(piece, {normal, offsets[j]}, objectives, &axes);
        EXPECT_EQ(fast[j].has_value(), plain.has_value()) << what;
        if (!plain || !fast[j]) continue;
        expect_equal(*fast[j], *plain, size, objectives.undercut_by_area, what + " offset " + std::to_string(j));
        if (::testing::Test::HasFatalFailure()) return j;
    }
    return offsets.size();
}

}  // namespace qchopper
