// What setup sheet, details, templates and pictures say of glue faces, held against the manifest of the same job.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cam/job/glue_faces.h"
#include "cam/job/read_job.h"
#include "cam/job/sheet/cap_template.h"
#include "cam/job/sheet/glue_section.h"
#include "cam/job/sheet/place_section.h"
#include "cam/job/sheet/setup_picture.h"
#include "cam/job/sheet/setup_sheet.h"
#include "cam/job/sheet/touch_points.h"
#include "cam/job/write_job.h"
#include "tests/cam/job/sawn_jobs.h"
#include "tests/segment/picture/eyes.h"

namespace qchopper {
namespace {

using namespace test_pieces;
using PieceSetup = qchopper::Setup;  // gtest has a Setup of its own

struct JobAndSheet {
    const JobInput* input = nullptr;
    ReadJob job;
    std::string sheet;
};

// Of the pieces that have jobs.
const std::vector<JobAndSheet>& all_sheets() {
    static const std::vector<JobAndSheet> all = [] {
        std::vector<JobAndSheet> made;
        for (std::size_t p = 0; p < sawn_jobs().inputs.size(); ++p) {
            if (p == sawn_jobs().middle) continue;
            const JobInput& input = sawn_jobs().inputs[p];
            JobAndSheet one{&input, parse_job(job_file(input), input.piece.name), {}};
            one.sheet = text_of(one.job.files.at("setup.html"));
            made.push_back(std::move(one));
        }
        return made;
    }();
    return all;
}

bool has(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

// The numbers in a text, in their order.
std::vector<double> numbers_in(const std::string& text) {
    std::vector<double> numbers;
    for (std::size_t at = 0; at < text.size();) {
        if (std::string("-0123456789").find(text[at]) == std::string::npos) {
            ++at;
            continue;
        }
        std::size_t end = at + 1;
        while (end < text.size() && std::string("0123456789.").find(text[end]) != std::string::npos) ++end;
        if (end > at + 1 || text[at] != '-') numbers.push_back(std::stod(text.substr(at, end - at)));
        at = end;
    }
    return numbers;
}

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
    const std::size_t from = text.find(begin);
    if (from == std::string::npos) return {};
    return text.substr(from + begin.size(), text.find(end, from + begin.size()) - from - begin.size());
}

// The entries of the row of a table that begins with a text, without tags.
std::vector<std::string> row(const std::string& sheet, const std::string& first) {
    std::vector<std::string> entries;
    const std::size_t at = sheet.find("<tr><td>" + first + "</td>");
    if (at == std::string::npos) return entries;
    std::string text = sheet.substr(at + 4, sheet.find("</tr>", at) - at - 4);
    for (std::size_t end = text.find("</td>"); end != std::string::npos; end = text.find("</td>")) {
        std::string entry = text.substr(0, end);
        for (std::size_t tag = entry.find('<'); tag != std::string::npos; tag = entry.find('<')) {
            entry.erase(tag, entry.find('>', tag) - tag + 1);
        }
        entries.push_back(entry);
        text.erase(0, end + 5);
    }
    return entries;
}

TEST(GlueSheet, SizesAndFoamAreThoseOfTheManifest) {
    std::size_t flush = 0;
    for (const JobAndSheet& one : all_sheets()) {
        const PieceSetup& setup = one.job.setup;
        const std::vector<double> size = numbers_in(between(one.sheet, "Saw it down to ", " mm;"));
        ASSERT_EQ(size.size(), 3U) << one.sheet;
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(size[static_cast<std::size_t>(axis)], setup.block.size[axis], 1e-6) << "no digit is lost";
        }
        EXPECT_EQ(one.job.foam_at_faces.empty(), setup.flush_caps.empty());
        if (setup.flush_caps.empty()) continue;
        ++flush;
        const std::vector<GlueFace> glued = glue_faces(setup, one.job.caps);
        for (std::size_t f = 0; f < block_faces; ++f) {
            const auto face = static_cast<BlockFace>(f);
            const std::vector<std::string> entries = row(one.sheet, names_of(face)(face));
            ASSERT_EQ(entries.size(), 4U) << names_of(face)(face) << one.sheet;
            EXPECT_NEAR(std::stod(entries[1]), one.job.foam_at_faces[f], 0.051);
            const auto of_face =
                std::find_if(glued.begin(), glued.end(), [&](const GlueFace& g) { return g.face == face; });
            EXPECT_EQ(entries[2].substr(entries[2].find_first_not_of(' ')),
                      of_face == glued.end() ? "-" : list_of_pieces(of_face->neighbours));
        }
        EXPECT_TRUE(has(one.sheet, "more than 0.5 mm off is sawn again; a glue face is never milled."));
    }
    EXPECT_GE(flush, 3U);
}

TEST(GlueSheet, OfABlockWithoutAGlueFaceSaysNothingOfThem) {
    EXPECT_EQ(glue_face_section(tilting_job()), "");
    EXPECT_EQ(glue_keys(tilting_job()), "");
    EXPECT_FALSE(has(setup_sheet(tilting_job(), 60), "lue face"));
}

TEST(GlueSheet, ATouchOffToleranceTakesThePlaceOfTheFoamWhereAGlueFaceIsAtTheSide) {
    std::size_t touched = 0;
    for (const JobAndSheet& one : all_sheets()) {
        const TouchFaces faces = touch_faces(one.job.setup);
        const bool is_glued = faces.first.has_value();
        touched += is_glued ? 1 : 0;
        EXPECT_EQ(has(one.sheet, "by 0.2 mm and 0.02 degrees (assumed)"), is_glued);
        EXPECT_EQ(has(one.sheet, "the foam around the piece is what the block may be off"), !is_glued);
        EXPECT_EQ(has(one.sheet, "Touch off three corners"), !is_glued);
        for (const TouchPoint& point : touch_points(one.job.setup)) {
            const std::vector<std::string> entries = row(one.sheet, point.name);
            ASSERT_EQ(entries.size(), 8U);
            EXPECT_EQ(entries[1], point.where);
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_NEAR(std::stod(entries[static_cast<std::size_t>(2 + axis)]), point.at[axis], 0.051);
            }
        }
        if (!is_glued) continue;
        EXPECT_TRUE(has(one.sheet, std::string("P1 and P2 on glue face ") + names_of(*faces.first)(*faces.first)));
        EXPECT_TRUE(has(one.sheet, "z comes from the table: z = 0 is 10.0 mm above it"));
    }
    EXPECT_GE(touched, 2U);
}

// Of opposite glue faces one is touched, and the sheet says which takes the error.
TEST(GlueSheet, OfOppositeGlueFacesTheOtherTakesTheErrorOfTheSize) {
    JobInput input = sawn_jobs().inputs[sawn_jobs().middle];
    const TouchFaces faces = touch_faces(input.setup);
    const std::string sheet = place_section(input);
    for (const std::optional<BlockFace>& face : {faces.first, faces.second}) {
        ASSERT_TRUE(face.has_value());
        const std::string touched = names_of(*face)(*face);
        const std::string other = (touched[0] == '-' ? "+" : "-") + touched.substr(1);
        EXPECT_TRUE(has(sheet, "Do not touch " + other + ", opposite of " + touched)) << sheet;
    }
    const BlockFace first = *faces.first;
    std::erase_if(input.setup.flush_caps,
                  [&](const FlushCap& cap) { return axis_of(cap.face) == axis_of(first) && cap.face != first; });
    const std::string without = place_section(input);
    EXPECT_FALSE(has(without, std::string("opposite of ") + names_of(first)(first)));
}

// Numbers of the holes that a sentence of the sheet names.
std::set<std::size_t> holes_in(const std::string& sentence) {
    std::set<std::size_t> holes;
    std::string text = sentence;
    for (std::size_t at = text.find("by template-"); at != std::string::npos; at = text.find("by template-")) {
        for (const double number : numbers_in(text.substr(0, at))) holes.insert(static_cast<std::size_t>(number));
        text.erase(0, text.find(".pdf", at) + 4);
    }
    return holes;
}

TEST(GlueSheet, HolesInSawnSidesAreDrilledBeforeTheBlockIsPlacedAndThoseOfTheTopAreLeftToTheRobot) {
    std::size_t before_milling = 0;
    std::size_t in_tops = 0;
    for (JobInput input : sawn_jobs().inputs) {
        std::set<std::size_t> side;
        std::set<std::size_t> top;
        std::vector<std::size_t> drilled;
        for (const DrawnCap& drawn : input.caps) {
            for (const FlushCap& flush : input.setup.flush_caps) {
                if (flush.cut != drawn.cap.cut) continue;
                for (const JobHole& hole : holes_of({drawn.cap})) {
                    (flush.face == BlockFace::top ? top : side).insert(hole.number);
                    EXPECT_EQ(has(hole.by_hand, "drill it before"), flush.face != BlockFace::top) << hole.by_hand;
                    if (flush.face == BlockFace::top) drilled.push_back(hole.number);
                }
            }
        }
        for (DrawnCap& drawn : input.caps) {
            for (CapJoint& joint : drawn.cap.joints) {
                for (JobHole& hole : joint.holes) {
                    if (top.contains(hole.number)) hole.by_hand.clear();
                }
            }
        }
        std::sort(drilled.begin(), drilled.end());
        decide_holes(input.caps, drilled, {}, "there is no program");
        const std::string sheet = setup_sheet(input, 60);
        const std::size_t place = sheet.find("<h2>2. ");
        const std::size_t end = sheet.find("<h2>6. ");
        const std::string first =
            between(sheet.substr(0, place), "before the block is placed and carved: holes ", "</p>");
        EXPECT_EQ(holes_in(first), side) << first;
        const std::string last = between(sheet.substr(end), "Drill by hand: ", "</p>");
        for (const std::size_t hole : holes_in(last)) EXPECT_FALSE(side.contains(hole) || top.contains(hole)) << last;
        if (!top.empty()) {
            EXPECT_TRUE(has(sheet.substr(end), "The robot drills " + std::to_string(top.size()) + " hole"));
        }
        before_milling += side.size();
        in_tops += top.size();
    }
    EXPECT_GE(before_milling, 2U);
    EXPECT_GE(in_tops, 1U);
}

// The outer line of the template is the side of the block: a hole lies from its edges as it does in the setup.
TEST(GlueSheet, TheTemplateOfASawnSideShowsTheEdgesOfTheBlock) {
    std::size_t sides = 0;
    for (const JobInput& input : sawn_jobs().inputs) {
        const Box block = input.setup.block_box();
        for (const DrawnCap& drawn : input.caps) {
            const auto flush = std::find_if(input.setup.flush_caps.begin(), input.setup.flush_caps.end(),
                                            [&](const FlushCap& cap) { return cap.cut == drawn.cap.cut; });
            const bool is_side = flush != input.setup.flush_caps.end() && flush->face != BlockFace::top;
            EXPECT_EQ(drawn.block_side.size(), is_side ? 4U : 0U);
            const CapTemplate drawing = cap_template(drawn, "B");
            EXPECT_EQ(drawing.outlines.size(), drawn.outline.size() + (is_side ? 1 : 0));
            if (!is_side) continue;
            ++sides;
            const int along = 1 - static_cast<int>(axis_of(flush->face));
            const std::vector<Point2>& edges = drawing.outlines.back();
            const auto apart = [](Point2 a, Point2 b) { return std::hypot(a.x - b.x, a.y - b.y); };
            EXPECT_NEAR(apart(edges[0], edges[1]), block.size()[along], 1e-6);
            EXPECT_NEAR(apart(edges[1], edges[2]), block.size().z, 1e-6);
            for (const Point2& corner : edges) {
                EXPECT_TRUE(corner.x > 5 && corner.y > 5 && corner.x < drawing.sheet.x - 5 &&
                            corner.y < drawing.sheet.y - 5);
            }
            const std::vector<JobHole> holes = holes_of({drawn.cap});
            for (std::size_t h = 0; h < holes.size(); ++h) {
                const Point2 at = drawing.circles[h].middle;
                const Vec3 corner{along == 0 ? block.min.x : holes[h].point.x,
                                  along == 0 ? holes[h].point.y : block.min.y, block.min.z};
                EXPECT_NEAR(apart(at, edges[0]), norm(holes[h].point - corner), 1e-6) << "hole " << holes[h].number;
            }
        }
    }
    EXPECT_GE(sides, 4U);
}

TEST(GlueSheet, ThePicturesShowEveryGlueFaceInItsColour) {
    std::vector<Rgb> colours{base_colour, bone_colour, {255, 255, 255}};
    for (std::size_t f = 0; f < block_faces; ++f) colours.push_back(glue_colour(static_cast<BlockFace>(f)));
    for (const SurfaceState state : {SurfaceState::hidden, SurfaceState::steep, SurfaceState::holder,
                                     SurfaceState::too_narrow, SurfaceState::ignored}) {
        colours.push_back(surface_colour(state, true));
    }
    const auto is_glue = [](std::size_t i) { return i >= 3 && i < 3 + block_faces; };
    for (std::size_t i = 0; i < colours.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (!is_glue(i) && !is_glue(k)) continue;
            EXPECT_GT(eyes::distance(colours[i], colours[k]), 15) << i << " and " << k;
        }
    }
    for (const JobAndSheet& one : all_sheets()) {
        if (one.job.setup.flush_caps.empty()) continue;
        JobInput milled = *one.input;
        milled.setup.flush_caps.clear();
        const ReadJob other = parse_job(job_file(milled), "other");
        EXPECT_NE(other.files.at("setup-1.png"), one.job.files.at("setup-1.png"));
    }
}

}  // namespace
}  // namespace qchopper
