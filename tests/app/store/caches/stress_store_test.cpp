#include "app/store/caches/stress_store.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>

#include "base/files/file.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

struct StressFiles : ::testing::Test {
    fs::path folder = fs::path(testing::TempDir()) / ("stress" + std::to_string(::getpid()));
    TriangleMesh scan = shapes::joined({shapes::torus({0, 0, 0}, 30, 9), shapes::ball({0, 0, 90}, 8)});
    StructureOptions load;
    void SetUp() override {
        load.up = {0, 1, 0};
        load.density_kg_per_m3 = 100;
        load.strength_mpa = 0.5;
        load.voxel_mm = 4;
    }
    void TearDown() override { fs::remove_all(folder); }

    // Whether it is found: what is computed reports progress.
    bool is_found() const {
        bool is_computed = false;
        Context context;
        context.on_progress = [&](const Progress&) { is_computed = true; };
        EXPECT_EQ(*kept_stress(folder, scan, load, context), stress_of(scan, load, {}));
        return !is_computed;
    }
    std::vector<fs::path> files() const {
        std::vector<fs::path> all;
        for (const auto& entry : fs::directory_iterator(folder)) all.push_back(entry.path());
        return all;
    }
};

TEST_F(StressFiles, ALaterRunFindsTheStressToTheLastBit) {
    EXPECT_FALSE(is_found());
    EXPECT_TRUE(is_found());
    load.force_n = 1;
    EXPECT_FALSE(is_found()) << "another load";
    scan.points[0].x += 1e-9;
    EXPECT_FALSE(is_found()) << "another scan";
    EXPECT_EQ(files().size(), 3U);
}

TEST_F(StressFiles, ADamagedFileIsComputedAgainAndReplaced) {
    EXPECT_FALSE(is_found());
    const fs::path file = files().at(0);
    const Bytes whole = read_file(file);
    for (const std::size_t at : {std::size_t{0}, whole.size() / 2, whole.size() - 1}) {
        Bytes damaged = whole;
        damaged[at] ^= 1;
        write_file(file, damaged);
        EXPECT_FALSE(is_found());
        EXPECT_EQ(read_file(file), whole);
    }
    write_file(file, Bytes(whole.begin(), whole.begin() + 100));
    EXPECT_FALSE(is_found());
    write_file(file, Bytes{});
    EXPECT_FALSE(is_found());
    EXPECT_TRUE(is_found());
}

TEST_F(StressFiles, AFolderThatCannotBeWrittenCostsNothingButTime) {
    write_file(folder, "a file");
    EXPECT_FALSE(is_found());
    EXPECT_FALSE(is_found());
}

TEST_F(StressFiles, ACancelledAnalysisLeavesNoFile) {
    const std::atomic<bool> cancelled{true};
    Context context;
    context.cancelled = &cancelled;
    EXPECT_THROW(kept_stress(folder, scan, load, context), Cancelled);
    EXPECT_FALSE(fs::exists(folder));
}

}  // namespace
}  // namespace qchopper
