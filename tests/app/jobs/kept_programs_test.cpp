// Programs that an earlier run left are taken again only if nothing that they were made from has changed.

#include "app/jobs/kept_programs.h"

#include <gtest/gtest.h>

#include <fstream>

#include "app/jobs/job_verdict.h"
#include "base/files/file.h"
#include "base/files/temporary_folder.h"
#include "cam/job/envelope_document.h"
#include "cam/job/job_caps.h"
#include "cam/job/job_program.h"
#include "cam/job/read_job.h"
#include "cam/job/write_job.h"
#include "tests/cam/job/some_job.h"

namespace qchopper {
namespace {

using namespace test_pieces;

// A folder with the two jobs of a piece whose program has two parts, each with its verdict.
class KeptPrograms : public testing::Test {
 protected:
    void SetUp() override {
        input_ = tilting_job(3);
        caps_ = {capped(input_, 2)};
        input_.caps = caps_;
        envelope_ = envelope_document(input_);
        decide_holes(input_.caps, {1}, {}, "the arm does not hold it");
        Sha256 before;
        for (std::uint16_t part = 1; part <= 2; ++part) before = write(part, before);
    }

    Sha256 write(std::uint16_t part, const Sha256& before) {
        ProgramInput program;
        program.program.entry = "qc_2_p" + std::to_string(part) + ".src";
        program.program.files = {program.program.entry};
        if (part == 2) program.program.holes = {1};
        program.program.moves_left_out = {6, "operation 2: link 5"};
        program.program.chunks = {{program.program.entry, 7, 0, 12, 345, {{-1, -2, 0}, {3, 4, 60}}, {}, {1, 1, 60}}};
        program.program.part = {part, 2, part > 1 ? std::optional(before) : std::nullopt};
        program.texts[program.program.entry] = "DEF part " + std::to_string(part);
        program.proof.figures = {{"time_s", "time", 77, "s", 0}, {"path_m", "path", 1.5, "m", 1}};
        program.proof.time.resize(1);
        program.proof.time[0].operation = "roughing";
        program.proof.time[0].cutting_s = 77;
        program.tools = {7};
        program.deviation_picture = {1, 2, part < 2 ? std::uint8_t{3} : std::uint8_t{4}};
        input_.program = program;
        const Bytes bytes = job_file(input_);
        write_file(file(part), bytes);
        JobVerdict verdict;
        verdict.job_sha256 = sha256(bytes);
        verdict.cell_sha256 = cell_;
        verdict.program_version = version_;
        verdict.figures = program.proof.figures;
        verdict.time = program.proof.time;
        verdict.notes = {describe(program.program.moves_left_out)};
        verdict.is_positive = true;
        write_verdict(file(part), verdict);
        return verdict.job_sha256;
    }

    std::filesystem::path file(std::uint16_t part) const { return folder_.path() / job_file_name("AB", part); }
    ProgramSource source() const {
        return {input_.piece, input_.setup, envelope_, input_.piece_no, caps_, cell_, version_};
    }
    bool is_kept(const ProgramSource& source) const { return kept_programs(folder_.path(), source).has_value(); }

    TemporaryFolder folder_{"qchopper-kept-"};
    JobInput input_;
    std::string envelope_;
    Sha256 cell_ = sha256({});
    std::string version_ = "0.1.0";
    std::vector<DrawnCap> caps_;  // of two holes, as before the program
};

TEST_F(KeptPrograms, AreThoseThatWereWritten) {
    const std::optional<PiecePrograms> kept = kept_programs(folder_.path(), source());
    ASSERT_TRUE(kept);
    ASSERT_EQ(kept->parts.size(), 2U);
    const ProvenProgram& last = kept->parts[1];
    EXPECT_EQ(last.input.texts.at("qc_2_p2.src"), "DEF part 2");
    EXPECT_EQ(last.input.deviation_picture, (Bytes{1, 2, 4}));
    EXPECT_FALSE(last.input.program.part.before);
    EXPECT_EQ(last.input.program.part.number, 2);
    EXPECT_EQ(last.input.tools, std::vector<std::uint16_t>{7});
    EXPECT_TRUE(last.proof.is_proven());
    EXPECT_EQ(last.input.program.holes, std::vector<std::size_t>{1});
    ASSERT_EQ(kept->caps.size(), 1U);
    EXPECT_EQ(kept->caps[0].cap, input_.caps[0].cap) << "who drills each hole is known again";
    EXPECT_EQ(last.input.program.moves_left_out, (MovesLeftOut{6, "operation 2: link 5"}));
    ASSERT_EQ(last.proof.notes.size(), 1U) << "what is left out is said again";
    EXPECT_NE(last.proof.notes.front().find("6 mm of its cuts: operation 2: link 5"), std::string::npos);
    EXPECT_EQ(last.proof.time_s, 77);
    EXPECT_EQ(last.proof.time, input_.program->proof.time);
    EXPECT_EQ(last.proof.length_mm, 1500);
    ProgramInput again = last.input;
    again.program.part.before = input_.program->program.part.before;
    JobInput same = input_;
    same.program = again;
    EXPECT_TRUE(job_file(same) == job_file(input_)) << "the same bytes come of it";
}

TEST_F(KeptPrograms, AreMadeAgainWhereTheirSourceChanged) {
    EXPECT_TRUE(is_kept(source()));
    qchopper::Setup setup = input_.setup;
    setup.placement.x += 1;
    EXPECT_FALSE(is_kept({input_.piece, setup, envelope_, input_.piece_no, caps_, cell_, version_}));
    EXPECT_FALSE(is_kept({input_.piece, input_.setup, envelope_, 3, caps_, cell_, version_}));
    Sha256 other_cell = cell_;
    other_cell.bytes[0] ^= 1U;
    EXPECT_FALSE(is_kept({input_.piece, input_.setup, envelope_, input_.piece_no, caps_, other_cell, version_}));
    const std::string newer = "0.2.0";
    EXPECT_FALSE(is_kept({input_.piece, input_.setup, envelope_, input_.piece_no, caps_, cell_, newer}));
    // The same setup, held by another arm configuration: its program is another one.
    JobInput held = placed_job();
    const std::string other_envelope = envelope_document(held);
    held.machine_reachability.regions.front().configuration.is_back =
        !held.machine_reachability.regions.front().configuration.is_back;
    EXPECT_NE(envelope_document(held), other_envelope);
    EXPECT_FALSE(is_kept({input_.piece, input_.setup, other_envelope, input_.piece_no, caps_, cell_, version_}));
    Piece piece = input_.piece;
    TriangleMesh mesh = *piece.mesh;
    mesh.points.front().x += 0.01;
    piece.mesh = std::make_shared<const TriangleMesh>(mesh);
    EXPECT_FALSE(is_kept({piece, input_.setup, envelope_, input_.piece_no, caps_, cell_, version_}));
    std::vector<DrawnCap> other_hole = caps_;
    other_hole[0].cap.joints[0].holes[0].depth += 1;
    EXPECT_FALSE(is_kept({input_.piece, input_.setup, envelope_, input_.piece_no, other_hole, cell_, version_}));
}

TEST_F(KeptPrograms, AreMadeAgainWhereAFileIsMissingOrDamaged) {
    std::filesystem::remove(verdict_file(file(1)));
    EXPECT_FALSE(is_kept(source()));
    write(1, {});
    EXPECT_TRUE(is_kept(source()));
    std::ofstream(file(2), std::ios::app) << "x";
    EXPECT_FALSE(is_kept(source()));
    std::filesystem::remove(file(2));
    EXPECT_FALSE(is_kept(source()));
}

}  // namespace
}  // namespace qchopper
