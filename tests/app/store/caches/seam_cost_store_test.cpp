#include "app/store/caches/seam_cost_store.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>

#include "base/files/file.h"
#include "segment/objectives/seam_cost.h"
#include "tests/pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

struct SeamCostFiles : ::testing::Test {
    fs::path folder = fs::path(testing::TempDir()) / ("seams" + std::to_string(::getpid()));
    std::vector<TriangleMesh> scan{shapes::torus({0, 0, 0}, 30, 9), shapes::ball({0, 0, 90}, 8)};
    void TearDown() override { fs::remove_all(folder); }

    std::vector<Piece> pieces() const { return {piece_of(scan[0]), piece_of(scan[1])}; }
    // The costs of all points as the store gives them.
    std::vector<std::vector<float>> kept() const {
        std::vector<Piece> uncut = pieces();
        find_kept_seam_costs(folder, uncut, {});
        return {*uncut[0].seam_cost, *uncut[1].seam_cost};
    }
    std::vector<std::vector<float>> found() const {
        std::vector<Piece> uncut = pieces();
        find_seam_costs(uncut);
        return {*uncut[0].seam_cost, *uncut[1].seam_cost};
    }
    std::vector<fs::path> files() const {
        std::vector<fs::path> all;
        for (const auto& entry : fs::directory_iterator(folder)) all.push_back(entry.path());
        return all;
    }
    // Whether the store asks for them again: a cancelled search for them throws.
    bool is_computed() const {
        const std::atomic<bool> cancelled{true};
        Context context;
        context.cancelled = &cancelled;
        std::vector<Piece> uncut = pieces();
        try {
            find_kept_seam_costs(folder, uncut, context);
        } catch (const Cancelled&) {
            return true;
        }
        return false;
    }
};

TEST_F(SeamCostFiles, ALaterRunFindsTheCostsToTheLastBit) {
    EXPECT_TRUE(is_computed());
    EXPECT_FALSE(fs::exists(folder)) << "what was cancelled is not kept";
    EXPECT_EQ(kept(), found());
    EXPECT_FALSE(is_computed());
    EXPECT_EQ(kept(), found());
    scan[1].points[0].x += 1e-9;
    EXPECT_TRUE(is_computed()) << "another scan";
    EXPECT_EQ(kept(), found());
    EXPECT_EQ(files().size(), 2U);
}

TEST_F(SeamCostFiles, ADamagedFileIsComputedAgainAndReplaced) {
    const auto expected = kept();
    const fs::path file = files().at(0);
    const Bytes whole = read_file(file);
    for (const std::size_t at : {std::size_t{0}, whole.size() / 2, whole.size() - 1}) {
        Bytes damaged = whole;
        damaged[at] ^= 1;
        write_file(file, damaged);
        EXPECT_TRUE(is_computed());
        EXPECT_EQ(kept(), expected);
        EXPECT_EQ(read_file(file), whole);
    }
    for (const std::size_t size : {std::size_t{0}, std::size_t{100}}) {
        write_file(file, Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
        EXPECT_TRUE(is_computed());
    }
}

TEST_F(SeamCostFiles, AFolderThatCannotBeWrittenCostsNothingButTime) {
    write_file(folder, "a file");
    EXPECT_EQ(kept(), found());
    EXPECT_TRUE(is_computed());
}

}  // namespace
}  // namespace qchopper
