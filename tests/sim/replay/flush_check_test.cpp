// Caps that are faces of the block, and lies about them. Leftover cannot see a block that is too long at a sawn face:
// the face is not milled, and what stays of it is not asked for.

#include "sim/replay/flush_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "base/error.h"
#include "segment/mesh/measure.h"
#include "sim/replay/replay.h"
#include "tests/shapes.h"
#include "tests/sim/replay/box_job.h"

namespace qchopper {
namespace {

constexpr std::size_t minus_x = 0;
constexpr std::size_t plus_x = 1;
constexpr std::size_t minus_y = 2;
constexpr std::size_t plus_y = 3;
constexpr std::size_t top = 4;

const Vec3 low{-30, -30, 0};
const Vec3 high{30, 30, 25};

// A box 60 mm wide; the block ends at it in +x and on top, and stands out by 10 mm elsewhere.
struct Sawn {
    Cell cell = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
    TriangleMesh target = shapes::box(low, high, 4);
    ReplayScene scene;

    Sawn() {
        scene.cell = &cell;
        scene.block = {{-40, -40, -12}, {30, 40, 25}};
        scene.caps = {{1, high, {1, 0, 0}, plus_x}, {2, high, {0, 0, 1}, top}, {3, low, {-1, 0, 0}, std::nullopt}};
    }

    // Turned about the vertical through its middle; the planes of its caps turn with it.
    void turn(double degrees) {
        const double angle = degrees * std::numbers::pi / 180;
        target = shapes::rotated(target, {0, 0, 1}, angle);
        for (SceneCap& cap : scene.caps) {
            const auto turned = [&](Vec3 v) {
                return Vec3{std::cos(angle) * v.x - std::sin(angle) * v.y,
                            std::sin(angle) * v.x + std::cos(angle) * v.y, v.z};
            };
            cap.point = turned(cap.point);
            cap.outward = turned(cap.outward);
        }
        scene.block.max.x = bounds(target).max.x;
    }

    // The findings, a line each; all are of the kind.
    std::string found() {
        scene.target = &target;
        FindingLog log;
        check_flush_faces(scene, log);
        std::string text;
        for (const Finding& finding : log.findings()) {
            EXPECT_EQ(finding.kind, FindingKind::flush_face);
            text += finding.text + "\n";
        }
        return text;
    }
};

TEST(FlushFaces, AsTheSawMakesThemThereIsNothingAgainstThem) {
    Sawn sawn;
    EXPECT_EQ(sawn.found(), "");
    sawn.scene.caps.clear();
    sawn.scene.block.max.x += 5;
    EXPECT_EQ(sawn.found(), "") << "where the caps are not known";
}

TEST(FlushFaces, ABlockAMillimetreLongerOrShorterIsRefused) {
    for (const double by : {1.0, -1.0}) {
        Sawn sawn;
        sawn.scene.block.max.x += by;
        EXPECT_EQ(
            sawn.found(),
            "the cap of cut 1 is said to be face +x of the block, and lies up to 1.00 mm from it, at most 0.15 are "
            "allowed\n");
        Sawn high_block;
        high_block.scene.block.max.z += by;
        EXPECT_NE(high_block.found().find("cut 2 is said to be face top"), std::string::npos);
    }
}

TEST(FlushFaces, ToleranceAndHalfAStepOfTheSizesAreAllowed) {
    for (const double tolerance : {0.0, 0.1, 0.4}) {
        Sawn sawn;
        sawn.scene.flush_tolerance = tolerance;
        sawn.scene.block.max.x = 30 + tolerance + 0.05;
        EXPECT_EQ(sawn.found(), "") << tolerance;
        sawn.scene.block.max.x += 0.005;
        EXPECT_NE(sawn.found(), "") << tolerance;
    }
}

TEST(FlushFaces, ACapOf60MmTurnedBy02DegreesIsNoFace) {
    Sawn sawn;
    sawn.turn(0.2);
    EXPECT_NE(sawn.found().find("cut 1 is said to be face +x of the block, and lies up to 0.21 mm from it"),
              std::string::npos);
    sawn.scene.caps[0].face.reset();
    EXPECT_EQ(sawn.found(), "") << "as a cap that is milled it may lie so";
    Sawn little;
    little.turn(0.04);
    EXPECT_EQ(little.found(), "");
    little.scene.caps[0].face.reset();
    EXPECT_EQ(little.found(),
              "the cap of cut 1 lies within 0.04 mm of face +x of the block, and the job does not say "
              "that it is sawn\n");
}

TEST(FlushFaces, AFaceThatIsSaidWhereThereIsAMarginIsRefused) {
    Sawn sawn;
    sawn.scene.caps[2].face = minus_x;
    EXPECT_NE(sawn.found().find("cut 3 is said to be face -x of the block, and lies up to 10.00 mm from it"),
              std::string::npos);
}

TEST(FlushFaces, AMarginThatIsSaidWhereTheBlockEndsIsRefused) {
    Sawn sawn;
    sawn.scene.caps[0].face.reset();
    EXPECT_EQ(sawn.found(),
              "the cap of cut 1 lies within 0.00 mm of face +x of the block, and the job does not say "
              "that it is sawn\n");
    sawn.cell.margins.sides = 0;
    EXPECT_EQ(sawn.found(), "") << "in a cell that keeps no foam beside a piece";
    sawn.scene.caps[1].face.reset();
    EXPECT_NE(sawn.found().find("cut 2 lies within 0.00 mm of face top"), std::string::npos);
}

TEST(FlushFaces, OnlyACapOfFourSquareCentimetresMustBeNamed) {
    for (const double wide : {15.9, 16.1}) {  // mm, 25 mm tall
        Sawn sawn;
        sawn.target = shapes::box({-30, 0, 0}, {30, wide, 25}, 2);
        sawn.scene.caps[0].face.reset();
        EXPECT_EQ(sawn.found().empty(), wide < 16) << wide;
    }
}

TEST(FlushFaces, TheOriginInTheMiddleOfThePieceIsRefused) {
    Sawn sawn;
    sawn.scene.block = {{-35, -40, -12}, {35, 40, 25}};
    EXPECT_NE(sawn.found().find("cut 1 is said to be face +x of the block, and lies up to 5.00 mm from it"),
              std::string::npos);
}

TEST(FlushFaces, ABlockShiftedInItsFrameIsRefused) {
    Sawn sawn;
    sawn.scene.block = {sawn.scene.block.min + Vec3{0.5, 0, 0}, sawn.scene.block.max + Vec3{0.5, 0, 0}};
    EXPECT_NE(sawn.found().find("lies up to 0.50 mm from it"), std::string::npos);
}

TEST(FlushFaces, ExchangedFacesAreRefused) {
    Sawn sawn;
    sawn.scene.caps[0].face = minus_x;
    sawn.scene.caps[2].face = plus_x;
    EXPECT_NE(sawn.found().find("cut 1 is said to be face -x"), std::string::npos);
    EXPECT_NE(sawn.found().find("cut 3 is said to be face +x"), std::string::npos);
    Sawn turned;
    turned.scene.caps[0].face = plus_y;
    EXPECT_NE(turned.found().find("cut 1 is said to be face +y"), std::string::npos);
    turned.scene.caps[0].face = minus_y;
    EXPECT_NE(turned.found().find("cut 1 is said to be face -y"), std::string::npos);
}

TEST(FlushFaces, ACapWithoutSurfaceIsRefused) {
    const std::string no_surface =
        "the cap of cut 9 is said to be face +x of the block, and the piece has no surface in its plane\n";
    Sawn sawn;
    sawn.scene.caps.push_back({9, high - Vec3{0.01, 0, 0}, {1, 0, 0}, plus_x});
    EXPECT_EQ(sawn.found(), no_surface);
    Sawn inward;
    inward.scene.caps.push_back({9, high, {-1, 0, 0}, plus_x});
    EXPECT_EQ(inward.found(), no_surface);
}

// Tools beside a piece 80 mm tall whose block is sawn in +x and on top, along straight lines.
struct Beside {
    Sawn sawn;
    ToolPath path;

    Beside() {
        sawn.target = shapes::box(low, {30, 30, 80}, 4);
        sawn.scene.caps[1].point.z = 80;
        sawn.scene.block.max.z = 80;
        sawn.scene.orientations = {{{0, 0, 1}, 0, {}}, {normalized({1, 0, 1}), 0, {}}};
        sawn.scene.target = &sawn.target;
    }
    // `tool`: index in the cell. The lines are numbered from 1.
    void go(std::size_t tool, Vec3 from, Vec3 to, std::uint32_t orientation = 0) {
        TipLine line;
        line.from = from;
        line.to = to;
        line.tool = static_cast<std::uint32_t>(tool);
        line.orientation = orientation;
        line.place = {0, static_cast<std::uint32_t>(path.lines.size() + 1)};
        path.lines.push_back(line);
    }
    std::vector<Finding> found() {
        FindingLog log;
        check_beside_flush_faces(path, sawn.scene, log, {});
        return log.findings();
    }
};

constexpr std::size_t flat_20 = 1;  // index in kr60-ha
constexpr std::size_t ball_12 = 2;

TEST(BesideFlushFaces, APassAlongTheFootOfASawnSideIsFoundWithItsLine) {
    for (const std::size_t tool : {flat_20, ball_12}) {
        Beside beside;
        const double radius = 0.5 * beside.sawn.cell.machine->tools[tool].diameter;
        beside.go(tool, {60, -50, 100}, {60, -50, 0});
        beside.go(tool, {60, -50, 0}, {60, 50, 0});
        EXPECT_TRUE(beside.found().empty());
        // The face may be off by 0.5 mm, and by 0.05 degrees over half its diagonal of 100 mm.
        beside.go(tool, {30.5 + 0.044 + radius, -50, 0}, {30.5 + 0.044 + radius, 50, 0});
        EXPECT_TRUE(beside.found().empty());
        beside.go(tool, {30 + radius, -50, 0}, {30 + radius, 50, 0});
        const std::vector<Finding> found = beside.found();
        ASSERT_EQ(found.size(), 1U);
        EXPECT_EQ(found[0].kind, FindingKind::flush_face);
        EXPECT_EQ(found[0].place.line, 4U);
        EXPECT_NEAR(found[0].number, 0.544, 0.005);
        EXPECT_NE(found[0].text.find("comes to a sawn face: 0.54 mm would be milled off it"), std::string::npos)
            << found[0].text;
    }
}

TEST(BesideFlushFaces, OverTheRimAToolMayGoByItsRadiusAndTwoMillimetres) {
    Beside beside;
    // The ball touches the face, where that stands out, up to 2.5 mm beside and under its centre.
    beside.go(ball_12, {36, -50, 80 - 11}, {36, 50, 80 - 11});
    beside.go(ball_12, {36, -50, 0}, {36, -25, 0});
    EXPECT_TRUE(beside.found().empty());
    beside.go(ball_12, {36, -50, 80 - 16}, {36, 50, 80 - 16});
    EXPECT_EQ(beside.found().size(), 1U);
    Beside aside;
    aside.go(ball_12, {36, -50, 0}, {36, -18, 0});
    EXPECT_EQ(aside.found().size(), 1U);
}

TEST(BesideFlushFaces, AToolThatLeansOverTheTopIsFound) {
    Beside beside;
    const double tip = 6 - 6 * std::sqrt(0.5);  // above the lowest point of the ball
    beside.go(ball_12, {0, -10, 80.1 + tip}, {0, 10, 80.1 + tip}, 1);
    const std::vector<Finding> found = beside.found();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NE(found[0].text.find("tool 3 comes to a sawn face"), std::string::npos) << found[0].text;
    Beside above;
    above.go(ball_12, {0, -10, 80.6 + tip}, {0, 10, 80.6 + tip}, 1);
    EXPECT_TRUE(above.found().empty());
}

TEST(BesideFlushFaces, WhereNoFaceIsSawnNothingIsAsked) {
    Beside beside;
    beside.go(flat_20, {35, -50, 0}, {35, 50, 0});
    EXPECT_FALSE(beside.found().empty());
    for (SceneCap& cap : beside.sawn.scene.caps) cap.face.reset();
    EXPECT_TRUE(beside.found().empty());
}

// A program that mills a box with a sawn side.
struct SawnBox {
    BoxJob job = sawn_box_job("kr60-ha");

    ReplayReport report() const {
        ReplayOptions options;
        options.cell = 0.5;
        return replay(read_back(job, job.files()), job.scene(), options);
    }
    // The kinds that are found, each once, in their order.
    static std::string kinds(const ReplayReport& report) {
        std::string words;
        for (std::size_t k = 0; k < finding_kinds; ++k) {
            if (report.counts[k] > 0) words += std::string(to_word(static_cast<FindingKind>(k))) + " ";
        }
        return words;
    }
    // Passes beside the cap, moved towards it.
    void move_passes_at_the_cap(double by) {
        for (WrittenMove& move : job.job.chunks[1].moves) {
            if (move.tip.x > 39) move.tip.x -= by;
        }
    }
};

TEST(FlushFaces, AProgramForASawnBlockIsGood) {
    EXPECT_EQ(SawnBox::kinds(SawnBox().report()), "");
}

TEST(FlushFaces, OfABlockAMillimetreLongerThatAloneIsFound) {
    SawnBox sawn;
    sawn.job.block.max.x += 1;
    sawn.move_passes_at_the_cap(-2);
    EXPECT_EQ(SawnBox::kinds(sawn.report()), "flush_face ");
}

TEST(FlushFaces, APathThreeTenthsIntoASawnSideIsAGouge) {
    SawnBox sawn;
    sawn.move_passes_at_the_cap(0.3);
    const ReplayReport report = sawn.report();
    EXPECT_GT(report.counts[static_cast<std::size_t>(FindingKind::gouge)], 0U);
    EXPECT_NEAR(report.largest_gouge, 0.3, 0.01);
}

TEST(FlushFaces, AFaceThatNoBlockHasIsNoScene) {
    SawnBox sawn;
    sawn.job.caps[0].face = SceneCap::faces;
    EXPECT_THROW(sawn.report(), InputError);
}

}  // namespace
}  // namespace qchopper
