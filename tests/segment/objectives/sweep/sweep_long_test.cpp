// Compares the sweep with cutting on specimens, on real scans, and on the pieces that cuts make of them.

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "base/error.h"
#include "segment/cut/cut_piece.h"
#include "segment/import/import_scan.h"
#include "segment/mesh/connectivity/solids.h"
#include "segment/mesh/order.h"
#include "segment/sample/sample.h"
#include "segment/search/candidates/candidates.h"
#include "segment/search/candidates/evaluate.h"
#include "tests/real_scans.h"
#include "tests/reference/segment/objectives/evaluate_by_cutting.h"
#include "tests/segment/objectives/sweep/same_evaluation.h"

namespace qchopper {
namespace {

// The solids of a scan as pieces, most faces first, without those too small to be pieces.
std::vector<Piece> pieces_of(const TriangleMesh& scan, std::size_t most) {
    std::vector<Piece> pieces;
    for (TriangleMesh& solid : split_solids(in_memory_order(scan), {0, 0, 1})) {
        if (volume_mm3(solid) < 1e-5 * volume_mm3(scan)) continue;
        Piece piece;
        piece.mesh = std::make_shared<const TriangleMesh>(std::move(solid));
        pieces.push_back(std::move(piece));
    }
    std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
        return a.mesh->triangles.size() > b.mesh->triangles.size();
    });
    if (pieces.size() > most) pieces.resize(most);
    return pieces;
}

// The best of all candidates of one evaluation.
struct Winner {
    std::size_t candidate = 0;
    double total = std::numeric_limits<double>::infinity();
};
Winner winner(const std::vector<std::optional<CutEvaluation>>& evaluations, const Objectives& objectives) {
    Winner best;
    for (std::size_t i = 0; i < evaluations.size(); ++i) {
        const auto t = evaluations[i] ? terms(*evaluations[i], {}, objectives) : std::nullopt;
        if (t && t->total < best.total) best = {i, t->total};
    }
    return best;
}

// All candidates of a piece both ways. Returns the plane of the winner.
Plane expect_same_candidates(const Piece& piece, const Objectives& objectives, int per_normal,
                             const std::string& what) {
    CandidateOptions options;
    options.offsets_per_normal = per_normal;
    const std::vector<Candidate> candidates = candidate_planes(piece, options);
    const auto fast = evaluate_all(piece, candidates, objectives, {});
    std::vector<std::optional<CutEvaluation>> plain;
    const double size = norm(bounds(*piece.mesh).size());
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        plain.push_back(evaluate_by_cutting(piece, candidates[i].plane, objectives));
        EXPECT_EQ(fast[i].has_value(), plain[i].has_value()) << what;
        if (!fast[i] || !plain[i]) continue;
        expect_equal(*fast[i], *plain[i], size, objectives.undercut_by_area, what + " candidate " + std::to_string(i));
        if (::testing::Test::HasFatalFailure()) return {};
    }
    const Winner a = winner(fast, objectives);
    const Winner b = winner(plain, objectives);
    EXPECT_NEAR(a.total, b.total, 1e-9) << what;
    return candidates.empty() ? Plane{} : candidates[a.candidate].plane;
}

// The scan, then the pieces of three cuts along the winners.
void expect_same_along_cuts(const TriangleMesh& scan, int per_normal, const std::string& what) {
    Objectives objectives;
    objectives.fragment_volume_mm3 = 1e-5 * volume_mm3(scan);
    for (Piece piece : pieces_of(scan, 2)) {
        for (std::int32_t cut_number = 1; cut_number <= 3; ++cut_number) {
            objectives.undercut_by_area = cut_number % 2 == 1;
            const Plane best = expect_same_candidates(piece, objectives, per_normal, what);
            if (::testing::Test::HasFailure() || piece.mesh->triangles.size() < 100) break;
            const auto made = cut_piece(piece, best, cut_number);
            if (!made) break;
            for (const Piece& p : made->pieces) {
                if (p.mesh->triangles.size() > made->pieces.front().mesh->triangles.size() / 2) piece = p;
            }
        }
    }
}

TEST(SweepLong, EqualsCuttingOnTheSamplesAlongRandomNormals) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    std::size_t planes = 0;
    for (const Specimen specimen : {Specimen::vertebra, Specimen::femur, Specimen::skull}) {
        SampleOptions options;
        options.faces = 20'000;
        const TriangleMesh scan = in_memory_order(sample(specimen, options));
        Piece piece;
        piece.mesh = std::make_shared<const TriangleMesh>(scan);
        for (int round = 0; round < 16; ++round) {
            const Vec3 n = canonical({normalized({normal(random), normal(random), normal(random)}), 0}).normal;
            const Extent range = extent(scan, n);
            std::vector<double> wanted;
            for (int k = 1; k < 25; ++k) wanted.push_back(range.low + range.size() * k / 25);
            planes += expect_same(piece, n, wanted, {}, "sample round " + std::to_string(round));
        }
    }
    EXPECT_GT(planes, 1000U);
}

TEST(SweepLong, EqualsCuttingOnTheSamplesAndTheirPieces) {
    for (const Specimen specimen : {Specimen::vertebra, Specimen::femur, Specimen::skull}) {
        SampleOptions options;
        options.faces = 60'000;
        expect_same_along_cuts(sample(specimen, options), 15, "sample");
    }
}

TEST(SweepLong, EqualsCuttingOnEveryValidScan) {
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
        expect_same_along_cuts(imported.mesh, scan.faces > 100'000 ? 8 : 40, scan.file);
        if (HasFailure()) return;
    }
    EXPECT_GE(taken, 5U);
}

}  // namespace
}  // namespace qchopper
