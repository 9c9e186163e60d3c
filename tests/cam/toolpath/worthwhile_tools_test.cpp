// Which tools finish what: pieces of which it is plain what each tool is good for.

#include "cam/toolpath/worthwhile_tools.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <vector>

#include "base/parallel.h"
#include "tests/cam/cell/short_tools.h"
#include "tests/cam/toolpath/toolpath_pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

using Tools = std::vector<std::size_t>;

// Balls of 20, 12 and 6 mm are its tools 0, 2 and 3.
Cell kr60() {
    return with_short_tools(read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml"));
}

Tools chosen(const TriangleMesh& mesh, FineTools fine) {
    ToolpathSettings settings;
    settings.fine = fine;
    const Cell cell = kr60();
    const ToolChoice choice = choose_tools(*cell.machine, settings);
    return worthwhile_tools(test_pieces::setup_of(mesh), mesh, cell, choice.finishing, settings, {});
}

// A slab whose upper side is waved along x, with creases that only a ball below their radius fills.
TriangleMesh waved(double size, double length, double high) {
    constexpr std::size_t cells = 160;
    TriangleMesh mesh = test_pieces::bumpy(size, cells, 1, 1);
    for (Vec3& p : mesh.points) {
        if (p.z > 0) p.z = 30 + high * std::abs(std::sin(3.14159265 * p.x / length));
    }
    return mesh;
}

TEST(WorthwhileTools, AreTheLargestAloneWhereItFinishesAll) {
    EXPECT_EQ(chosen(shapes::box({0, 0, 0}, {40, 40, 40}), FineTools::worthwhile), Tools{0});
    EXPECT_EQ(chosen(shapes::box({0, 0, 0}, {40, 40, 40}), FineTools::all), (Tools{0, 2, 3}));
    EXPECT_EQ(chosen(shapes::box({0, 0, 0}, {40, 40, 40}), FineTools::none), Tools{0});
}

TEST(WorthwhileTools, AreSmallerOnesWhereCreasesAreMany) {
    const TriangleMesh creased = waved(300, 25, 12);
    const Tools tools = chosen(creased, FineTools::worthwhile);
    EXPECT_EQ(tools.back(), 3U) << "only the smallest comes to the bottom of the creases";
    EXPECT_EQ(chosen(creased, FineTools::none).back(), 0U) << "none below the largest that is smaller than the rougher";
    const Tools smooth = chosen(waved(300, 300, 12), FineTools::worthwhile);
    EXPECT_EQ(smooth.front(), 0U);
    EXPECT_LE(smooth.size(), 2U);
}

TEST(WorthwhileTools, DoNotDependOnTheNumberOfThreads) {
    const TriangleMesh creased = waved(120, 25, 12);
    const Tools tools = chosen(creased, FineTools::worthwhile);
    const ThreadLimit one(1);
    EXPECT_EQ(chosen(creased, FineTools::worthwhile), tools);
}

}  // namespace
}  // namespace qchopper
