// Walks scans through all modules in process: scan, pieces, setup, job, ticket, hand-off over TCP to a simulated cell.

#include <gtest/gtest.h>

#include "app/engine/presets.h"
#include "segment/io/write_mesh.h"
#include "segment/sample/sample.h"
#include "tests/data_flow/data_flow.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// Real meshes do not come with the project.
#define NEEDS_SCAN(name)                                      \
    const fs::path scan = fs::path(QCHOPPER_MESHES) / (name); \
    if (!fs::exists(scan)) GTEST_SKIP() << "skipped: " << (name) << " is not here"

ImportedScan import_as(const fs::path& path, Unit unit) {
    ImportOptions options;
    options.mm_per_unit = mm_per(unit);
    return import_scan(path, options);
}

TEST(Walk, ASampleScanBecomesJobsThatEnd) {
    for (const auto& [specimen, holes] : {std::pair(Specimen::vertebra, 0), std::pair(Specimen::femur, 2)}) {
        const walk::Folder folder;
        SampleOptions sampling;
        sampling.faces = 3000;
        sampling.holes = holes;
        write_file(folder.path / "scan.ply", to_ply(sample(specimen, sampling)));
        const ImportedScan imported = import_as(folder.path / "scan.ply", Unit::mm);
        EXPECT_EQ(imported.report.repair.holes_filled, static_cast<std::size_t>(holes));
        SearchSettings settings;
        settings.stop.min_cuts = 2;
        const Segmentation segmentation = walk::cut_up(imported.mesh, settings);
        EXPECT_GE(segmentation.pieces.size(), 3U);
        const Cell cell = walk::foam_cell();
        walk::run_jobs(walk::write_jobs(segmentation, imported, cell, folder.path), cell, folder.path);
    }
}

TEST(Walk, TheBunnyBecomesFourPiecesOrMoreAndTheirJobsEnd) {
    NEEDS_SCAN("bunny_bun_zipper.ply");
    const walk::Folder folder;
    const ImportedScan imported = import_as(scan, Unit::m);
    EXPECT_EQ(imported.mesh.triangles.size(), 69'664U);
    EXPECT_EQ(imported.report.repair.holes_filled, 5U);
    const std::optional<SearchSettings> settings = preset("bunny");
    ASSERT_TRUE(settings);
    const Segmentation segmentation = walk::cut_up(imported.mesh, *settings);
    EXPECT_EQ(segmentation.cuts.size(), 3U);
    EXPECT_GE(segmentation.pieces.size(), 4U);
    const Cell cell = walk::foam_cell();
    walk::run_jobs(walk::write_jobs(segmentation, imported, cell, folder.path), cell, folder.path);
}

TEST(Walk, AHeadOf222ShellsBecomesClosedPiecesAndListedFragments) {
    NEEDS_SCAN("ct_head_371k.ply");
    const walk::Folder folder;
    const ImportedScan imported = import_as(scan, Unit::mm);
    EXPECT_EQ(imported.report.repair.shells, 222U);
    SearchSettings settings;
    settings.stop.min_cuts = 1;
    settings.candidates.offsets_per_normal = 8;  // the invariant is about the pieces, not about the choice
    const Segmentation segmentation = walk::cut_up(imported.mesh, settings);
    EXPECT_GT(segmentation.fragments.size(), 100U);
    EXPECT_GT(segmentation.pieces.size(), 10U);
    walk::write_jobs(segmentation, imported, walk::foam_cell(), folder.path);
}

}  // namespace
}  // namespace qchopper
