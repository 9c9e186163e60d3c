// The job of a piece with a glue face from the saw, in a ready KUKA cell, and lies about its block: a writer that errs
// writes them into all files of the job alike, so that reading and proof have to see them.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/zip.h"
#include "base/text.h"
#include "cam/job/read_job.h"
#include "cam/job/write_job.h"
#include "cam/setup/stock_fit.h"
#include "segment/cut/cut_piece.h"
#include "segment/search/segmentation.h"
#include "tests/app/jobs/proven_job.h"
#include "tests/segment/objectives/extruded.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

constexpr std::int32_t base_cut = 1;
constexpr std::int32_t sawn_cut = 2;
constexpr std::int32_t milled_cut = 3;

// The cap of a ball, pressed so that no turn of it is the same piece, less what lies beyond a plane through its middle
// and a plane askew.
Piece sawn_piece() {
    constexpr double radius = 64;
    constexpr double tall = 30;
    Piece piece = uncut(shapes::ball({0, 0, 0}, radius, 40), 0).pieces.front();
    piece = cut_piece(piece, {{0, 0, 1}, radius - tall}, base_cut)->pieces.front();
    TriangleMesh pressed = *piece.mesh;
    for (Vec3& point : pressed.points) point.y *= 0.8;
    piece.mesh = std::make_shared<TriangleMesh>(std::move(pressed));
    piece = cut_piece(piece, {{1, 0, 0}, 0}, sawn_cut)->pieces.front();
    piece = cut_piece(piece, {normalized({0.3, 0.9, 0}), -12}, milled_cut)->pieces.front();
    piece.name = "A";
    return piece;
}

const ProvenJob& sawn_job() {
    static const ProvenJob job = made_and_proven("kr60-ha", sawn_piece());
    return job;
}

Vec3 outward_of(BlockFace face) {
    switch (face) {
        case BlockFace::minus_x:
            return {-1, 0, 0};
        case BlockFace::plus_x:
            return {1, 0, 0};
        case BlockFace::minus_y:
            return {0, -1, 0};
        case BlockFace::plus_y:
            return {0, 1, 0};
        case BlockFace::top:
            break;
    }
    return {0, 0, 1};
}

BlockFace opposite_of(BlockFace face) {
    return static_cast<BlockFace>(static_cast<std::size_t>(face) ^ 1U);
}

// By a quarter turn about the vertical: -x, +x, -y, +y to -y, +y, +x, -x.
BlockFace turned(BlockFace face) {
    constexpr std::array<BlockFace, block_faces> after{BlockFace::minus_y, BlockFace::plus_y, BlockFace::plus_x,
                                                       BlockFace::minus_x, BlockFace::top};
    return after[static_cast<std::size_t>(face)];
}

int axis_of(BlockFace face) {
    return static_cast<int>(face) / 2;
}

void shift_piece(Setup& setup, Vec3 by) {
    setup.piece_in_setup.shift = setup.piece_in_setup.shift + by;
    setup.box = {setup.box.min + by, setup.box.max + by};
}

void turn_piece(Setup& setup) {
    setup.piece_in_setup = Pose{{Vec3{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}, {}} * setup.piece_in_setup;
    const Box box = setup.box;
    setup.box = {{-box.max.y, box.min.x, box.min.z}, {-box.min.y, box.max.x, box.max.z}};
    std::swap(setup.block.size.x, setup.block.size.y);
}

struct Lie {
    std::string name;
    std::function<void(Setup&)> tell;
    bool is_seen_by_proof = true;  // also without the checks of reading
};

const std::vector<Lie>& lies() {
    static const std::vector<Lie> all{
        {"block longer", [](Setup& setup) { setup.block.size[axis_of(setup.flush_caps[0].face)] += 1; }},
        {"block shorter", [](Setup& setup) { setup.block.size[axis_of(setup.flush_caps[0].face)] -= 1; }},
        {"block longer at the sawn face alone",
         [](Setup& setup) {
             setup.block.size[axis_of(setup.flush_caps[0].face)] += 1;
             shift_piece(setup, -0.5 * outward_of(setup.flush_caps[0].face));
         }},
        {"block shifted outwards in its frame",
         [](Setup& setup) { shift_piece(setup, -0.5 * outward_of(setup.flush_caps[0].face)); }},
        {"block shifted inwards in its frame",
         [](Setup& setup) { shift_piece(setup, 0.5 * outward_of(setup.flush_caps[0].face)); }},
        {"flush cap dropped",
         [](Setup& setup) {
             setup.milled_caps_mm2 += setup.flush_caps[0].area_mm2;
             setup.flush_caps.clear();
         }},
        {"milled cap added",
         [](Setup& setup) {
             setup.flush_caps.push_back({milled_cut, BlockFace::top, setup.milled_caps_mm2});
             setup.milled_caps_mm2 = 0;
         }},
        {"milled cap in place of the flush one", [](Setup& setup) { setup.flush_caps[0].cut = milled_cut; }},
        {"cap of no cut added",
         [](Setup& setup) {
             setup.flush_caps.push_back({77, setup.flush_caps[0].face, 500});
         },
         false},
        {"base added",
         [](Setup& setup) {
             setup.flush_caps.insert(setup.flush_caps.begin(), {base_cut, setup.flush_caps[0].face, 500});
         },
         false},
        {"margins of two faces exchanged",
         [](Setup& setup) {
             const int axis = axis_of(setup.flush_caps[0].face);
             const double margin = setup.block.size[axis] - setup.box.size()[axis];
             shift_piece(setup, -margin * outward_of(setup.flush_caps[0].face));
         }},
        {"face exchanged with the opposite one",
         [](Setup& setup) { setup.flush_caps[0].face = opposite_of(setup.flush_caps[0].face); }},
        {"face exchanged with one beside it",
         [](Setup& setup) { setup.flush_caps[0].face = turned(setup.flush_caps[0].face); }},
        {"turned by 90 degrees", [](Setup& setup) { turn_piece(setup); }},
        {"turned by 90 degrees, with its faces",
         [](Setup& setup) {
             turn_piece(setup);
             setup.flush_caps[0].face = turned(setup.flush_caps[0].face);
         }},
        {"origin in the middle of the piece",
         [](Setup& setup) {
             shift_piece(setup, -Vec3{setup.box.centre().x, setup.box.centre().y, 0});
         }},
    };
    return all;
}

std::set<std::string> kinds_of(const JobVerdict& verdict) {
    std::set<std::string> kinds;
    for (const ProofFinding& finding : verdict.findings) kinds.insert(finding.kind);
    return kinds;
}

std::string joined(const std::set<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

TEST(SawnJobs, AreProvenAndSayWhichCapIsSawn) {
    const ProvenJob& proven = sawn_job();
    EXPECT_TRUE(proven.verdict.is_positive) << describe(proven.verdict.findings.front());
    EXPECT_EQ(proven.job.setup.base, base_cut);
    ASSERT_EQ(proven.job.setup.flush_caps.size(), 1U);
    EXPECT_EQ(proven.job.setup.flush_caps[0].cut, sawn_cut);
    EXPECT_NE(proven.job.setup.flush_caps[0].face, BlockFace::top);
    EXPECT_GT(proven.job.setup.milled_caps_mm2, 400);
    EXPECT_TRUE(judged(parse_job(job_file(proven.input), "A.qjob"), proven.cell).is_positive) << "written again";
}

TEST(SawnJobs, EachLieAboutTheBlockIsRefused) {
    const ProvenJob& proven = sawn_job();
    for (const Lie& lie : lies()) {
        JobInput input = proven.input;
        lie.tell(input.setup);
        input.stock_fit = check_stock_fit(input.setup, input.cell);
        const Bytes bytes = job_file(input);
        std::string by_reading;
        try {
            const JobVerdict verdict = judged(parse_job(bytes, "A.qjob"), proven.cell);
            EXPECT_FALSE(verdict.is_positive) << lie.name;
        } catch (const InputError& error) {
            by_reading = error.what();
        }
        if (!lie.is_seen_by_proof) {
            EXPECT_NE(by_reading, "") << lie.name;
            std::printf("%s: %s\n", lie.name.c_str(), by_reading.c_str());
            continue;
        }
        ReadJob job = proven.job;
        job.setup = input.setup;
        job.files.at("piece.stl") = unzip(bytes, "A.qjob").at("piece.stl");
        const std::set<std::string> kinds = kinds_of(judged(job, proven.cell));
        EXPECT_TRUE(kinds.contains("flush_face") || kinds.contains("gouge")) << lie.name << ": " << joined(kinds);
        std::printf("%s: %s; proof: %s\n", lie.name.c_str(), by_reading.c_str(), joined(kinds).c_str());
    }
}

// Flat skin that goes on where a sawn cap ends, in its plane, is no glue face: it is skin to be proven, and the face of
// the block has it already. Fails if all of a face's triangles are taken for its cap.
TEST(SawnJobs, FlatSkinInThePlaneOfASawnCapIsSkin) {
    constexpr double height = 24;
    constexpr double width = 40;
    // Seen along y: a foot, and on it half a step back a wall, whose side at x = 0 is skin.
    Piece piece =
        uncut(extruded({{-30, -10}, {30, -10}, {30, height}, {0, height}, {0, height - 14}, {-30, height - 18}}, 0,
                       width),
              0)
            .pieces.front();
    piece = cut_piece(piece, {{0, 0, 1}, 0}, base_cut)->pieces.front();
    piece = cut_piece(piece, {{1, 0, 0}, 0}, sawn_cut)->pieces.front();
    piece.name = "A";
    const ProvenJob proven = made_and_proven("kr60-ha", piece);
    EXPECT_TRUE(proven.verdict.is_positive) << describe(proven.verdict.findings.front());
    const auto& setup = proven.job.setup;
    EXPECT_EQ(setup.base, base_cut);
    ASSERT_EQ(setup.flush_caps.size(), 1U);
    EXPECT_EQ(setup.flush_caps[0].cut, sawn_cut);
    EXPECT_NEAR(setup.flush_caps[0].area_mm2, width * (height - 14), 0.01 * width * height);
    EXPECT_EQ(setup.milled_caps_mm2, 0);
}

// The lines of a chunk with a pass beside the sawn face, `beside` its radius away from it, along its foot.
std::string with_pass_along_the_face(const std::string& text, const Setup& setup, double away) {
    const std::size_t last = text.rfind("LIN {");
    const std::size_t end = text.find('\n', last) + 1;
    const std::string retract = text.substr(text.find("Z ", last) + 2);
    const double above = std::stod(retract);
    const BlockFace face = setup.flush_caps[0].face;
    const Vec3 outward = outward_of(face);
    const Vec3 along = cross({0, 0, 1}, outward);
    const Box box = setup.block_box();
    const double half = 0.5 * std::abs(dot(along, box.size())) + 10;
    const Vec3 middle = (std::abs(dot(outward, 0.5 * box.size())) + away) * outward;
    std::string pass;
    for (const auto& [side, z] : {std::pair{-1.0, above}, {-1.0, 0.0}, {1.0, 0.0}, {1.0, above}}) {
        const Vec3 tip = middle + side * half * along;
        pass += "LIN {X " + fixed(tip.x, 2) + ",Y " + fixed(tip.y, 2) + ",Z " + fixed(z, 2) + "}\r\n";
    }
    const std::string back = text.substr(last, end - last);
    return text.substr(0, end) + pass + back.substr(0, back.find('}') + 1) + "\r\n" + text.substr(end);
}

TEST(SawnJobs, APassOfTheFloorAlongTheSawnFaceIsRefused) {
    const ProvenJob& proven = sawn_job();
    constexpr std::uint16_t ball_20 = 1;
    constexpr double radius = 10;
    for (const double away : {radius, radius + 3}) {
        ProgramFiles files = texts_of(proven.job);
        bool is_changed = false;
        for (const JobChunk& chunk : proven.job.program->chunks) {
            if (is_changed || chunk.tool != ball_20 || chunk.orientation != 0) continue;
            for (ProgramFile& file : files) {
                if (file.name != chunk.file) continue;
                file.text = with_pass_along_the_face(file.text, proven.job.setup, away);
                is_changed = true;
            }
        }
        ASSERT_TRUE(is_changed) << "no chunk of tool 1 from above";
        const JobVerdict verdict = judged(remade(proven, files), proven.cell);
        std::string texts;
        for (const ProofFinding& finding : verdict.findings) texts += describe(finding) + "\n";
        EXPECT_EQ(joined(kinds_of(verdict)), away == radius ? "flush_face" : "") << texts;
    }
}

}  // namespace
}  // namespace qchopper
