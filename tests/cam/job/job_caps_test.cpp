#include "cam/job/job_caps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "base/error.h"
#include "base/files/zip.h"
#include "base/json_fields.h"
#include "cam/job/cap_document.h"
#include "cam/job/read_job.h"
#include "cam/job/sheet/cap_template.h"
#include "cam/job/sheet/template_pdf.h"
#include "cam/job/write_job.h"
#include "segment/io/read_mesh.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/transform.h"
#include "segment/mesh/triangle_tree.h"
#include "tests/cam/job/some_job.h"
#include "tests/folder.h"
#include "tests/segment/joint/cut_pieces.h"

namespace qchopper {
namespace {

using namespace test_pieces;

struct JobsOfPieces {
    Segmentation segmentation;
    std::vector<PieceJoint> joints;
    std::vector<JobInput> inputs;
    std::vector<ReadJob> jobs;
};

// A torus in six pieces or so, all with jobs.
const JobsOfPieces& some_jobs() {
    static const JobsOfPieces all = [] {
        JobsOfPieces made;
        std::mt19937 random(3);
        made.segmentation = cut_randomly(shapes::torus({30, -20, 10}, 80, 32, 24), 4, random);
        const std::vector<Piece>& pieces = made.segmentation.pieces;
        made.joints = piece_joints(pieces, {});
        for (std::size_t p = 0; p < pieces.size(); ++p) {
            JobInput input = some_job();
            input.piece = pieces[p];
            input.piece_no = static_cast<std::uint16_t>(p + 1);
            input.piece_count = static_cast<std::uint16_t>(pieces.size());
            SetupOptions options;
            options.mapped = 0;
            input.setup = choose_setup(pieces[p], input.cell, options).setups.front();
            input.stock_fit = check_stock_fit(input.setup, input.cell);
            input.caps = caps_of(pieces, p, made.joints, input.setup, input.cell);
            decide_holes(input.caps, {}, {}, "there is no program");
            made.jobs.push_back(parse_job(job_file(input), pieces[p].name));
            made.inputs.push_back(std::move(input));
        }
        return made;
    }();
    return all;
}

const CapJoint* joint_towards(const ReadJob& job, std::int32_t cut, const std::string& neighbour) {
    for (const JobCap& cap : job.caps) {
        if (cap.cut != cut) continue;
        for (const CapJoint& joint : cap.joints) {
            if (joint.neighbour == neighbour) return &joint;
        }
    }
    return nullptr;
}

TEST(JobCaps, WhatIsReadIsWhatWasWritten) {
    const JobsOfPieces& all = some_jobs();
    for (std::size_t p = 0; p < all.jobs.size(); ++p) {
        ASSERT_EQ(all.jobs[p].caps.size(), all.inputs[p].caps.size());
        for (std::size_t c = 0; c < all.jobs[p].caps.size(); ++c) {
            EXPECT_EQ(all.jobs[p].caps[c], all.inputs[p].caps[c].cap);
        }
    }
}

// Rebuilt from their jobs alone, by the inverse of how they lie.
TEST(JobCaps, PiecesOfTheJobsMeetAndSoDoTheirHoles) {
    const JobsOfPieces& all = some_jobs();
    const std::vector<Piece>& pieces = all.segmentation.pieces;
    double farthest = 0;
    double holes_apart = 0;
    std::size_t holes = 0;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        const TriangleMesh lying = parse_mesh(all.jobs[p].files.at("piece.stl"), "piece.stl").mesh;
        const TriangleMesh rebuilt = apply(inverse(all.jobs[p].setup.piece_in_setup), lying);
        const TriangleTree tree(*pieces[p].mesh);
        for (const Vec3& point : rebuilt.points) {
            farthest = std::max(farthest, tree.nearest(*pieces[p].mesh, point).distance);
        }
    }
    EXPECT_LE(farthest, 0.005);  // of each of two that meet: 0.01 mm together
    for (const PieceJoint& joint : all.joints) {
        const ReadJob& below = all.jobs[joint.below];
        const ReadJob& above = all.jobs[joint.above];
        const CapJoint* first = joint_towards(below, joint.cut, pieces[joint.above].name);
        const CapJoint* second = joint_towards(above, joint.cut, pieces[joint.below].name);
        ASSERT_TRUE(first != nullptr && second != nullptr);
        ASSERT_EQ(first->holes.size(), joint.dowels.size());
        ASSERT_EQ(second->holes.size(), joint.dowels.size());
        for (std::size_t h = 0; h < joint.dowels.size(); ++h) {
            ++holes;
            const Vec3 a = apply_inverse(below.setup.piece_in_setup, first->holes[h].point);
            const Vec3 b = apply_inverse(above.setup.piece_in_setup, second->holes[h].point);
            const Vec3 into_a = rotate_inverse(below.setup.piece_in_setup, first->holes[h].axis);
            const Vec3 into_b = rotate_inverse(above.setup.piece_in_setup, second->holes[h].axis);
            holes_apart = std::max({holes_apart, norm(a - b), 100 * norm(into_a + into_b)});
            EXPECT_NEAR(dot(into_b, joint.plane.normal), 1, 1e-9);
            EXPECT_EQ(first->holes[h].diameter, second->holes[h].diameter);
        }
    }
    EXPECT_LE(holes_apart, 0.02);
    EXPECT_GE(holes, 4u);
}

TEST(JobCaps, ABaseIsNeverDrilledByTheRobotAndEveryCapHasItsTemplates) {
    const JobsOfPieces& all = some_jobs();
    for (const ReadJob& job : all.jobs) {
        for (const JobCap& cap : job.caps) {
            EXPECT_TRUE(job.files.contains(template_name(cap.cut, "svg")));
            EXPECT_TRUE(job.files.contains(template_name(cap.cut, "pdf")));
            if (job.setup.base != cap.cut) continue;
            for (const CapJoint& joint : cap.joints) {
                for (const JobHole& hole : joint.holes) EXPECT_FALSE(hole.by_robot);
            }
        }
        const Bytes& sheet = job.files.at("details.html");
        EXPECT_NE(std::string(sheet.begin(), sheet.end()).find("<h2>Joints</h2>"), std::string::npos);
    }
}

TEST(JobCaps, AHoleWhoseCapNoToolComesOutOfIsForTheHand) {
    Segmentation s = uncut(shapes::box({0, 0, 0}, {120, 100, 100}, 2), 0);
    ASSERT_TRUE(cut_at(s, "A", {{0, 0, 1}, 50}));
    const std::vector<PieceJoint> joints = piece_joints(s.pieces, {});
    const std::size_t below = joints.at(0).below;
    qchopper::Setup setup;  // as it lies in the scan: its cap looks up
    setup.box = bounds(*s.pieces[below].mesh);
    const auto reasons = [&](const qchopper::Setup& lying, const Cell& in) {
        const std::vector<DrawnCap> caps = caps_of(s.pieces, below, joints, lying, in);
        std::vector<std::string> by;
        for (const JobHole& hole : caps.at(0).cap.joints.at(0).holes) {
            EXPECT_EQ(hole.number, by.size() + 1);
            EXPECT_FALSE(hole.by_robot) << "nobody has decided yet";
            by.push_back(hole.by_hand);
        }
        return by;
    };
    const auto twice = [](const std::string& why) { return std::vector<std::string>{why, why}; };
    const Cell robot = read_cell(QCHOPPER_SOURCE_DIR "/cells/kr60-ha.toml");
    EXPECT_EQ(reasons(setup, robot), twice(""));
    EXPECT_EQ(reasons(setup, cell()), twice("the cell file describes no machine"));
    const double degree = std::numbers::pi / 180;
    const double c = std::cos(70 * degree);
    const double s70 = std::sin(70 * degree);
    setup.piece_in_setup = {{Vec3{1, 0, 0}, Vec3{0, c, -s70}, Vec3{0, s70, c}}, {}};
    EXPECT_EQ(reasons(setup, robot), twice("the tool would lean by 70 degrees, and 60 are allowed"));
    setup.base = 1;
    EXPECT_EQ(reasons(setup, robot), twice("its cap is the base, which lies on the table"));
}

TEST(JobCaps, OfEveryHoleItIsSaidWhoDrillsIt) {
    DrawnCap drawn;
    drawn.cap.joints.resize(1);
    for (std::size_t number = 1; number <= 4; ++number) {
        JobHole hole;
        hole.number = number;
        if (number == 2) hole.by_hand = "its cap is the base";
        drawn.cap.joints[0].holes.push_back(hole);
    }
    std::vector<DrawnCap> caps{drawn};
    decide_holes(caps, {1}, {{3, "the piece stands over it"}}, "there is no program");
    std::vector<std::string> why;
    for (const JobHole& hole : holes_of({caps[0].cap})) {
        why.push_back(hole.by_hand);
        EXPECT_EQ(hole.by_robot, hole.by_hand.empty());
    }
    EXPECT_EQ(why,
              (std::vector<std::string>{"", "its cap is the base", "the piece stands over it", "there is no program"}));
}

// As a manifest gives them back.
std::vector<JobCap> as_read(const std::vector<JobCap>& caps, const Pose& lying) {
    nlohmann::ordered_json json;
    json_values::put(json, caps);
    std::vector<JobCap> read;
    json_values::take(nlohmann::ordered_json::parse(json.dump()), "caps", read);
    check_caps(read, lying);
    return read;
}

TEST(JobCaps, AForgedHoleIsRefused) {
    const JobsOfPieces& all = some_jobs();
    std::vector<JobCap> caps;
    Pose lying;
    for (const ReadJob& job : all.jobs) {
        if (job.caps.empty() || job.caps[0].joints[0].holes.empty()) continue;
        caps = job.caps;
        lying = job.setup.piece_in_setup;
    }
    ASSERT_FALSE(caps.empty());
    EXPECT_EQ(as_read(caps, lying), caps);
    std::vector<JobCap> forged = caps;
    forged[0].joints[0].holes[0].point.x += 0.01;
    EXPECT_THROW(as_read(forged, lying), std::runtime_error);
    forged = caps;
    forged[0].joints[0].holes[0].axis = -forged[0].joints[0].holes[0].axis;
    EXPECT_THROW(as_read(forged, lying), std::runtime_error);
    forged = caps;
    forged[0].joints[0].holes[0].number = 7;
    EXPECT_THROW(as_read(forged, lying), std::runtime_error);
    forged = caps;
    forged[0].joints[0].holes[0].by_robot = true;  // and a reason for the hand
    EXPECT_THROW(as_read(forged, lying), std::runtime_error);
    EXPECT_NE(fault_of_templates(caps, {}).find("missing"), std::string::npos);
    EXPECT_NE(fault_of_templates({}, {{"template-9.svg", {}}}).find("no cap"), std::string::npos);
}

// A piece of a box of that size, and the template of its only cap.
DrawnCap cap_of_box(Vec3 size) {
    Segmentation s = uncut(shapes::box({0, 0, 0}, size, 2), 0);
    EXPECT_TRUE(cut_at(s, "A", {{0, 0, 1}, size.z / 2}));
    const std::vector<PieceJoint> joints = piece_joints(s.pieces, {});
    return caps_of(s.pieces, 0, joints, qchopper::Setup{}, cell()).at(0);
}

TEST(CapTemplate, IsInTrueSizeAndTheSameBytesEachTime) {
    const DrawnCap cap = cap_of_box({220, 100, 100});
    EXPECT_NEAR(std::max(cap.size.x, cap.size.y), 220, 1e-9);
    EXPECT_NEAR(std::min(cap.size.x, cap.size.y), 100, 1e-9);
    const CapTemplate drawing = cap_template(cap, "B");
    const std::string svg = template_svg(drawing);
    EXPECT_NE(svg.find("width=\"" + std::to_string(static_cast<int>(std::round(std::max(150.0, drawing.sheet.x))))),
              std::string::npos);
    EXPECT_NE(svg.find("100 mm"), std::string::npos);
    EXPECT_NE(svg.find("Piece B, cut 1"), std::string::npos);
    EXPECT_EQ(svg, template_svg(cap_template(cap, "B")));
    CapTemplate bar;
    add_scale_bar(bar, {3, 4});
    EXPECT_NEAR(bar.lines.at(0).at(1).x - bar.lines.at(0).at(0).x, 100, 1e-9);
}

// The numbers are those of the list of joints: without them nobody knows which hole is which.
TEST(CapTemplate, EveryHoleHasItsNumber) {
    JobInput input = some_job();
    const CapTemplate drawing = cap_template(capped(input, 4), "AB");
    const std::string svg = template_svg(drawing);
    const Bytes pdf = template_pdf(drawing);
    const std::string text(pdf.begin(), pdf.end());
    for (std::size_t number = 1; number <= 4; ++number) {
        EXPECT_NE(svg.find(">" + std::to_string(number) + "</text>"), std::string::npos) << number;
        EXPECT_NE(text.find("(" + std::to_string(number) + ") Tj"), std::string::npos) << number;
    }
}

std::size_t count_of(const std::string& text, const std::string& word) {
    std::size_t count = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
    return count;
}

TEST(TemplateTiles, AreA4AndTogetherCoverTheDrawing) {
    EXPECT_EQ(tiles_of({190, 200}).corners.size(), 1U);
    EXPECT_EQ(tiles_of({270, 160}).corners.size(), 1U) << "lying";
    std::mt19937 random(5);
    std::uniform_real_distribution<double> length(1, 1500);
    for (int i = 0; i < 200; ++i) {
        const Point2 sheet{length(random), length(random)};
        const TemplateTiles tiles = tiles_of(sheet);
        EXPECT_EQ(tiles.corners.size(), tiles.columns * tiles.rows);
        EXPECT_NEAR(tiles.paper.x * tiles.paper.y, 210 * 297, 1e-9);
        EXPECT_TRUE(tiles.window.x < tiles.paper.x && tiles.window.y < tiles.paper.y);
        // A hole with its cross, anywhere in the drawing, lies whole on one tile.
        std::uniform_real_distribution<double> share(0, 1);
        for (int k = 0; k < 20; ++k) {
            const double reach = tile_overlap / 2;
            const Point2 at{share(random) * sheet.x, share(random) * sheet.y};
            const bool is_whole = std::any_of(tiles.corners.begin(), tiles.corners.end(), [&](Point2 corner) {
                const auto holds = [&](double x, double from, double size, double most) {
                    return std::max(0.0, x - reach) >= from - 1e-9 && std::min(most, x + reach) <= from + size + 1e-9;
                };
                return holds(at.x, corner.x, tiles.window.x, sheet.x) && holds(at.y, corner.y, tiles.window.y, sheet.y);
            });
            EXPECT_TRUE(is_whole) << sheet.x << " x " << sheet.y << " at " << at.x << ", " << at.y;
        }
    }
}

TEST(TemplatePdf, HasAPageOfA4ForEachTileThatSaysWhichItIs) {
    for (const Vec3 size : {Vec3{120, 100, 100}, Vec3{520, 400, 100}}) {
        const CapTemplate drawing = cap_template(cap_of_box(size), "B");
        const Bytes bytes = template_pdf(drawing);
        EXPECT_EQ(bytes, template_pdf(drawing));
        const std::string pdf(bytes.begin(), bytes.end());
        EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
        const TemplateTiles tiles = tiles_of(drawing.sheet);
        const std::size_t pages = tiles.corners.size();
        EXPECT_EQ(pages > 1, size.x > 500);
        EXPECT_EQ(count_of(pdf, "/MediaBox [ 0 0 595.2") + count_of(pdf, "/MediaBox [ 0 0 841.8"), pages);
        EXPECT_EQ(count_of(pdf, "Piece B, cut 1"), pages);
        EXPECT_EQ(count_of(pdf, "100 mm: measure this bar"), pages);
        for (std::size_t tile = 1; pages > 1 && tile <= pages; ++tile) {
            EXPECT_EQ(count_of(pdf, "Tile " + std::to_string(tile) + " of " + std::to_string(pages) + ": row"), 1U)
                << tile;
        }
        // Nothing but a shift stands between the drawing and the paper: it is in true size.
        EXPECT_EQ(count_of(pdf, "\n1 0 0 1 "), pages);
        EXPECT_EQ(count_of(pdf, " cm\n"), pages);
    }
}

TEST(TemplatePdf, OfMoreThanFiveMetresIsRefused) {
    CapTemplate drawing;
    drawing.sheet = {100, 5001};
    EXPECT_THROW(template_pdf(drawing), InputError);
}

}  // namespace
}  // namespace qchopper
