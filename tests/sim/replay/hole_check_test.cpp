// Lines of a drill against holes: what each of them is said to be, with the place of the line.

#include "sim/replay/hole_check.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/text.h"

namespace qchopper {
namespace {

// Two holes of a cap at z = 40 that are drilled, one that is for the hand; tools 4, 5, 6 are drills of 8, 6, 4 mm.
struct Holes {
    Cell cell = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
    ReplayScene scene;

    Holes() {
        scene.cell = &cell;
        scene.orientations = {{{0, 0, 1}, 0, {}}, {normalized({1, 0, 1}), 0, {}}};
        scene.holes = {{1, {0, 0, 40}, {0, 0, -1}, 8, 22, true, true},
                       {2, {30, 0, 40}, {0, 0, -1}, 6, 16, true, true},
                       {3, {60, 0, 40}, {0, 0, -1}, 6, 16, false, false},
                       {4, {90, 0, 40}, {0, 0, -1}, 6, 16, true, false}};
    }

    double full(std::size_t tool, double depth) const { return depth + point_height(cell.machine->tools[tool]); }

    // Down to a depth of the full diameter at x, y.
    TipLine down(std::size_t tool, double x, double y, double depth, std::uint32_t hole = 0) const {
        TipLine line;
        line.from = {x, y, 45};
        line.to = {x, y, 40 - full(tool, depth)};
        line.place = {0, 17};
        line.tool = static_cast<std::uint32_t>(tool);
        line.hole = hole;
        return line;
    }

    // The way back up from a line's end, and a line down from there.
    static TipLine up(const TipLine& down) {
        TipLine line = down;
        std::swap(line.from, line.to);
        line.place.line = 18;
        line.follows_line = true;
        return line;
    }
    static TipLine following(TipLine line, std::uint32_t place) {
        line.follows_line = true;
        line.place.line = place;
        return line;
    }

    // Kinds of the findings, "hole_depth:17 missing_hole:0"
    std::string kinds(const std::vector<TipLine>& lines, HoleFigures* figures = nullptr,
                      bool removes_foam = true) const {
        FindingLog log;
        HoleCheck check(scene, log);
        for (const TipLine& line : lines) check.take_line(line, removes_foam);
        const HoleFigures found = check.finish();
        if (figures != nullptr) *figures = found;
        std::string kinds;
        for (const Finding& finding : log.findings()) {
            kinds += (kinds.empty() ? "" : " ") + std::string(to_word(finding.kind)) + ":" +
                     std::to_string(finding.place.line);
        }
        return kinds;
    }
};

TEST(HoleCheck, HolesAsOrderedAreFoundNothingAgainst) {
    const Holes of;
    HoleFigures figures;
    const TipLine peck = of.down(4, 0, 0, 10);
    const TipLine last = Holes::following(of.down(4, 0, 0, 22), 19);
    EXPECT_EQ(of.kinds({peck, Holes::up(peck), last, Holes::up(last), of.down(5, 30.15, 0, 16.1)}, &figures), "");
    EXPECT_EQ(figures.due, 2U);
    EXPECT_EQ(figures.drilled, 2U);
    EXPECT_NEAR(figures.largest_offset, 0.15, 1e-9);
}

TEST(HoleCheck, EachFaultHasItsKind) {
    const Holes of;
    const TipLine first = of.down(4, 0, 0, 22);
    const TipLine second = of.down(5, 30, 0, 16);
    EXPECT_EQ(of.kinds({}), "missing_hole:0 missing_hole:0");
    EXPECT_EQ(of.kinds({first}), "missing_hole:0");
    EXPECT_EQ(of.kinds({first, of.down(5, 30.21, 0, 16)}), "shifted_hole:17");
    EXPECT_EQ(of.kinds({first, of.down(5, 30, 0, 16.21)}), "hole_depth:17");
    EXPECT_EQ(of.kinds({first, of.down(5, 30, 0, 15.79)}), "hole_depth:17");
    EXPECT_EQ(of.kinds({first, of.down(6, 30, 0, 16)}), "hole_diameter:17");
    EXPECT_EQ(of.kinds({first, second, of.down(5, 15, 0, 16)}), "extra_hole:17");
    EXPECT_EQ(of.kinds({first, second, of.down(5, 60, 0, 16)}), "extra_hole:17") << "it is for the hand";
    EXPECT_EQ(of.kinds({first, second, of.down(5, 90, 0, 16)}), "extra_hole:17") << "another part drills it";
    TipLine aslant = of.down(5, 30, 0, 16);
    aslant.from.x += 0.5;
    EXPECT_EQ(of.kinds({first, aslant}), "shifted_hole:17");
    TipLine leaning = second;
    leaning.orientation = 1;
    EXPECT_EQ(of.kinds({first, leaning}), "missing_hole:0 extra_hole:17");
}

TEST(HoleCheck, AHoleIsDrilledInOneRunAndDeeperByEachStroke) {
    const Holes of;
    const TipLine first = of.down(4, 0, 0, 22);
    const TipLine second = of.down(5, 30, 0, 16);
    const TipLine half = of.down(5, 30, 0, 8);
    const TipLine rest = Holes::following(second, 19);
    EXPECT_EQ(of.kinds({first, second, second}), "repeated_hole:17");
    EXPECT_EQ(of.kinds({second, first, second}), "repeated_hole:17") << "another hole in between";
    EXPECT_EQ(of.kinds({first, half, Holes::up(half), second}), "repeated_hole:17") << "it went away at half depth";
    EXPECT_EQ(of.kinds({first, half, Holes::up(half), rest}), "") << "a peck";
    EXPECT_EQ(of.kinds({first, second, Holes::up(second), rest}), "repeated_hole:19") << "no deeper";
    EXPECT_EQ(of.kinds({first, second, Holes::up(second), rest, second}), "repeated_hole:19 repeated_hole:17");
    TipLine aside = Holes::up(half);
    aside.to.x += 8;
    EXPECT_EQ(of.kinds({first, half, aside, rest}), "repeated_hole:19 extra_hole:18") << "it left the axis by a line";
    HoleFigures figures;
    EXPECT_EQ(of.kinds({first, second, second}, &figures, false), "missing_hole:0 missing_hole:0 repeated_hole:17");
    of.kinds({first, second, second}, &figures);
    EXPECT_EQ(figures.drilled, 1U) << "a hole that is drilled twice is not as the job says";
}

TEST(HoleCheck, ALineBelongsToTheHoleThatItsCommentNames) {
    const Holes of;
    const TipLine first = of.down(4, 0, 0, 22);
    EXPECT_EQ(of.kinds({first, of.down(5, 38, 0, 16)}), "missing_hole:0 extra_hole:17");
    EXPECT_EQ(of.kinds({first, of.down(5, 38, 0, 16, 2)}), "shifted_hole:17");
    EXPECT_EQ(of.kinds({first, of.down(5, 30, 0, 16, 77)}), "") << "a number of no hole says nothing";
}

TEST(HoleCheck, FoamMayBeMissingInTheRobotsHolesAndNowhereElse) {
    const Holes of;
    const HoleSpace space(of.scene);
    EXPECT_FALSE(space.is_empty());
    EXPECT_TRUE(space.has({0, 4.2, 30}));
    EXPECT_FALSE(space.has({0, 4.3, 30}));
    EXPECT_TRUE(space.has({0, 0, 40 - of.full(4, 22) - 0.2}));
    EXPECT_FALSE(space.has({0, 0, 40 - of.full(4, 22) - 0.3}));
    EXPECT_FALSE(space.has({0, 0, 40.3}));
    EXPECT_FALSE(space.has({60, 0, 30})) << "drilled by hand, after the program";
    EXPECT_TRUE(space.has({90, 0, 30})) << "drilled by the part before";
}

}  // namespace
}  // namespace qchopper
