// Programs that an earlier run made are taken again only if nothing that they were made from has changed.

#include "app/jobs/kept_programs.h"

#include <gtest/gtest.h>

#include <functional>

#include "app/store/caches/cache_file.h"
#include "base/files/file.h"
#include "base/files/temporary_folder.h"
#include "cam/job/job_caps.h"
#include "tests/cam/job/some_job.h"

namespace qchopper {
namespace {

using namespace test_pieces;

ProvenProgram part_of(std::uint16_t number) {
    ProvenProgram part;
    JobProgram& program = part.input.program;
    program.entry = "qc_000000_2_p" + std::to_string(number) + ".src";
    const std::string chunk = "qc_000000_2_00" + std::to_string(number) + ".src";
    program.files = {program.entry, chunk};
    if (number == 2) program.holes = {1};
    program.moves_left_out = {6, "operation 2: link 5"};
    program.chunks = {{chunk, 7, 0, 12, 345, {{-1, -2, 0}, {3, 4, 60}}, {1.0 / 3, 0, 0}, {1, 1, 60}}};
    program.part = {number, 2, {}};
    part.input.texts = {{program.entry, "DEF qc_000000_2_p1( )\r\n;qc_000000_2\r\nqc_000000_2_001( )\r\n"},
                        {chunk, "DEF qc_000000_2_001( )\r\n"}};
    part.input.proof.figures = {{"time_s", "time", 77, "s", 0}, {"path_m", "path", 1.5, "m", 1}};
    part.input.proof.time.resize(1);
    part.input.proof.time[0].operation = "roughing";
    part.input.proof.time[0].cutting_s = 77;
    part.input.tools = {7};
    part.input.deviation_picture = {1, 2, static_cast<std::uint8_t>(number)};
    if (number == 2) part.input.stock = {9, 8};
    static_cast<ProofResult&>(part.proof) = part.input.proof;
    part.proof.chunks = program.chunks;
    part.proof.time_s = 77.25;
    part.proof.length_mm = 1500.125;
    return part;
}

// A piece whose program has two parts, kept in a folder.
class KeptPrograms : public testing::Test {
 protected:
    void SetUp() override {
        own_job = tilting_job(3);
        own_job.project_id = {};
        own_job.caps = {capped(own_job, 2)};
        own_programs.caps = own_job.caps;
        decide_holes(own_programs.caps, {1}, {}, "the arm does not hold it");
        own_programs.parts = {part_of(1), part_of(2)};
        keep_programs(file(own_job), {own_job, cell_file}, own_programs);
    }

    std::filesystem::path file(const JobInput& job) const { return programs_file(temporary.path(), {job, cell_file}); }
    std::optional<PiecePrograms> kept(const JobInput& job) const { return kept_programs(file(job), {job, cell_file}); }
    bool is_kept_after(const std::function<void(JobInput&)>& change) const {
        JobInput job = own_job;
        change(job);
        return kept(job).has_value();
    }

    TemporaryFolder temporary{"qchopper-kept-"};
    JobInput own_job;
    PiecePrograms own_programs;
    Sha256 cell_file = sha256({});
};

void expect_same(const ProvenProgram& a, const ProvenProgram& b) {
    EXPECT_EQ(a.input.program, b.input.program);
    EXPECT_EQ(a.input.texts, b.input.texts);
    EXPECT_EQ(a.input.tools, b.input.tools);
    EXPECT_EQ(a.input.proof, b.input.proof);
    EXPECT_EQ(a.input.deviation_picture, b.input.deviation_picture);
    EXPECT_EQ(a.input.stock, b.input.stock);
    EXPECT_EQ(static_cast<const ProofResult&>(a.proof), b.proof);
    EXPECT_EQ(a.proof.chunks, b.proof.chunks);
    EXPECT_EQ(a.proof.time_s, b.proof.time_s);
    EXPECT_EQ(a.proof.length_mm, b.proof.length_mm);
}

TEST_F(KeptPrograms, AreThoseThatWereMade) {
    const std::optional<PiecePrograms> found = kept(own_job);
    ASSERT_TRUE(found);
    ASSERT_EQ(found->parts.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) expect_same(found->parts[i], own_programs.parts[i]);
    ASSERT_EQ(found->caps.size(), 1U);
    EXPECT_EQ(found->caps[0].cap, own_programs.caps[0].cap) << "who drills each hole is known again";
    EXPECT_FALSE(found->place);
    own_programs.place = BlockPlacement{1.0 / 3, -2, 0.5, {1, 2}};
    own_programs.parts.clear();
    own_programs.none_because = "no arm reaches it";
    own_programs.is_machine_refusing = true;
    keep_programs(file(own_job), {own_job, cell_file}, own_programs);
    const std::optional<PiecePrograms> none = kept(own_job);
    ASSERT_TRUE(none) << "that there is none takes as long to find";
    EXPECT_EQ(none->place, own_programs.place);
    EXPECT_EQ(none->none_because, own_programs.none_because);
    EXPECT_TRUE(none->is_machine_refusing) << "a run that goes on takes fewer tool orientations too";
    EXPECT_TRUE(none->parts.empty());
}

TEST_F(KeptPrograms, AreMadeAgainWhereTheirSourceChanged) {
    EXPECT_TRUE(is_kept_after([](JobInput&) {}));
    EXPECT_FALSE(is_kept_after([](JobInput& job) { job.setup.placement.x += 1; }));
    EXPECT_FALSE(is_kept_after([](JobInput& job) { job.setup.access.orientations[1].tool_axis.x += 1e-9; }));
    EXPECT_FALSE(is_kept_after([](JobInput& job) { job.program_version = "0.2.0"; }));
    EXPECT_TRUE(is_kept_after([](JobInput& job) { job.program_version += "+1a2b3c4d5e6f"; })) << "another build";
    EXPECT_FALSE(is_kept_after([](JobInput& job) { job.piece.half_spaces[0].plane.offset += 1e-9; }));
    EXPECT_FALSE(is_kept_after([](JobInput& job) { job.caps[0].cap.joints[0].holes[0].depth += 1; }));
    EXPECT_FALSE(is_kept_after([](JobInput& job) {
        TriangleMesh mesh = *job.piece.mesh;
        mesh.points.front().x += 1e-9;
        job.piece.mesh = std::make_shared<const TriangleMesh>(mesh);
    }));
    // The same setup, held by another arm configuration: its program is another one.
    const JobInput held = placed_job();
    keep_programs(file(held), {held, cell_file}, own_programs);
    JobInput other = held;
    EXPECT_TRUE(kept(other));
    bool& is_back = other.machine_reachability.regions.front().configuration.is_back;
    is_back = !is_back;
    EXPECT_FALSE(kept(other));

    Sha256 other_cell = cell_file;
    other_cell.bytes[0] ^= 1U;
    EXPECT_NE(programs_file(temporary.path(), {own_job, other_cell}), file(own_job));
    EXPECT_NE(programs_file(temporary.path(), {own_job, cell_file, FineTools::all}), file(own_job));
}

// What another decision changes in the job of a piece that it leaves alone.
TEST_F(KeptPrograms, StayWhereOtherPiecesChange) {
    EXPECT_TRUE(is_kept_after([](JobInput& job) {
        job.piece_count = 9;
        job.project_id[0] ^= 1U;
        job.warnings = {"another one"};
        job.caps[0].cap.joints[0].neighbour = "Z";
    }));
}

TEST_F(KeptPrograms, AreTakenForAnotherNumberOfThePiece) {
    JobInput third = own_job;
    third.piece_no = 3;
    const std::optional<PiecePrograms> found = kept(third);
    ASSERT_TRUE(found);
    const ProgramInput& first = found->parts[0].input;
    EXPECT_EQ(first.program.entry, "qc_000000_3_p1.src");
    EXPECT_EQ(first.program.files, (std::vector<std::string>{"qc_000000_3_p1.src", "qc_000000_3_001.src"}));
    EXPECT_EQ(first.program.chunks[0].file, "qc_000000_3_001.src");
    EXPECT_EQ(found->parts[0].proof.chunks, first.program.chunks);
    EXPECT_EQ(first.texts.at("qc_000000_3_p1.src"), "DEF qc_000000_3_p1( )\r\n;qc_000000_2\r\nqc_000000_3_001( )\r\n")
        << "a comment is no name";
    third.piece_no = third.piece_count = 12;
    EXPECT_FALSE(kept(third)) << "longer names: the program may be divided elsewhere";
    third.piece_no = 3;
    own_programs.parts[1].proof.findings.push_back({"gouge", "qc_000000_2_002.src", 3, "too deep"});
    own_programs.parts[1].input.proof = own_programs.parts[1].proof;
    keep_programs(file(own_job), {own_job, cell_file}, own_programs);
    const std::optional<PiecePrograms> refused = kept(third);
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->parts[1].proof.findings[0].file, "qc_000000_3_002.src");
    EXPECT_EQ(refused->parts[1].input.proof.findings, refused->parts[1].proof.findings);
    own_programs.parts[1].proof.findings[0].text = "too deep, behind qc_000000_2_001";
    own_programs.parts[1].input.proof = own_programs.parts[1].proof;
    keep_programs(file(own_job), {own_job, cell_file}, own_programs);
    EXPECT_TRUE(kept(own_job));
    EXPECT_FALSE(kept(third)) << "a sentence names a file";
}

TEST_F(KeptPrograms, AreTakenForAnotherOrder) {
    JobInput other = own_job;
    other.project_id[2] = 0xa5;
    const std::optional<PiecePrograms> found = kept(other);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->parts[0].input.program.entry, "qc_0000a5_2_p1.src");
    EXPECT_EQ(found->parts[0].input.texts.count("qc_0000a5_2_001.src"), 1U);
}

TEST_F(KeptPrograms, AreMadeAgainWhereTheirFileIsMissingOrDamaged) {
    const Bytes whole = read_file(file(own_job));
    for (const std::size_t at : {std::size_t{0}, whole.size() / 2, whole.size() - 1}) {
        Bytes damaged = whole;
        damaged[at] ^= 1U;
        write_file(file(own_job), damaged);
        EXPECT_FALSE(kept(own_job)) << at;
    }
    write_file(file(own_job), Bytes(whole.begin(), whole.begin() + 100));
    EXPECT_FALSE(kept(own_job));
    write_file(file(own_job), whole);
    EXPECT_TRUE(kept(own_job));
    std::filesystem::remove(file(own_job));
    EXPECT_FALSE(kept(own_job));
}

TEST_F(KeptPrograms, TheOldestAreRemoved) {
    using std::filesystem::exists;
    using std::filesystem::last_write_time;
    JobInput other = own_job;
    other.setup.placement.x += 1;
    keep_programs(file(other), {other, cell_file}, own_programs);
    write_file(temporary.path() / "x.stress", "another kind");
    const auto now = std::filesystem::file_time_type::clock::now();
    last_write_time(file(own_job), now - std::chrono::hours(2));
    last_write_time(file(other), now - std::chrono::hours(1));
    remove_oldest(temporary.path(), programs_ending, 2);
    EXPECT_TRUE(exists(file(own_job)) && exists(file(other)));
    EXPECT_TRUE(kept(own_job)) << "it was taken, and is now the newest";
    remove_oldest(temporary.path(), programs_ending, 1);
    EXPECT_TRUE(exists(file(own_job)));
    EXPECT_FALSE(exists(file(other)));
    EXPECT_TRUE(exists(temporary.path() / "x.stress"));
}

}  // namespace
}  // namespace qchopper
