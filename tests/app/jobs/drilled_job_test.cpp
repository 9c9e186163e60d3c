// A small piece with three holes, two straight down and one along a tilted cap, in all ready cells of the three
// dialects: the job as made is proven, and in those of KUKA every fault of its holes is found. A gantry drills straight
// down alone.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "app/dispatch/restart_job.h"
#include "app/jobs/piece_program.h"
#include "base/text.h"
#include "cam/job/read_job.h"
#include "segment/cut/cut_piece.h"
#include "segment/mesh/plane_frame.h"
#include "segment/search/segmentation.h"
#include "sim/program/chunk_summary.h"
#include "sim/program/krl_reader.h"
#include "sim/replay/signal_walk.h"
#include "tests/app/jobs/proven_job.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

const Plane base{{0, 0, 1}, 8};
const Plane top{{0, 0, 1}, 30};
const Plane slope{normalized({0.364, 0, 1}), 33};

// A ball of 80 mm between two planes, with a flat side that leans by 20 degrees.
Piece rounded_slab() {
    Piece piece = uncut(shapes::ball({0, 0, 0}, 40, 32), 0).pieces.front();
    piece = cut_piece(piece, base, 1)->pieces.front();
    piece = cut_piece(piece, top, 2)->pieces.back();
    piece = cut_piece(piece, slope, 3)->pieces.back();
    piece.name = "A";
    return piece;
}

struct Hole {
    double diameter, depth;
    Vec3 at;  // in the piece
};

DrawnCap cap_with(const Setup& setup, std::int32_t cut, const Plane& plane, const std::vector<Hole>& holes,
                  std::size_t first) {
    DrawnCap drawn;
    const PlaneFrame frame = frame_across(plane.normal);
    const Vec3 origin = plane.offset * plane.normal;
    drawn.cap.cut = cut;
    drawn.cap.cap_in_piece = inverse(Pose{{frame.u, frame.v, plane.normal},
                                          {-dot(frame.u, origin), -dot(frame.v, origin), -dot(plane.normal, origin)}});
    drawn.outline = {{{0, 0}, {40, 0}, {40, 40}, {0, 40}}};
    drawn.names_at = {{20, 20}};
    drawn.size = {40, 40};
    drawn.cap.joints = {{"B", 1000, "", {}}};
    const Pose cap_in_setup = setup.piece_in_setup * drawn.cap.cap_in_piece;
    for (const Hole& hole : holes) {
        const Vec3 p = apply_inverse(drawn.cap.cap_in_piece, hole.at);
        drawn.cap.joints[0].holes.push_back({first++,
                                             hole.diameter,
                                             hole.depth,
                                             {p.x, p.y},
                                             apply(cap_in_setup, {p.x, p.y, 0}),
                                             rotate(cap_in_setup, {0, 0, -1}),
                                             false,
                                             ""});
    }
    return drawn;
}

std::vector<DrawnCap> caps_of_slab(const Setup& setup) {
    EXPECT_EQ(setup.base, 1) << "the holes are made for the piece as it lies on its widest cap";
    return {cap_with(setup, 2, top, {{6, 16, {-8, 6, 30}}, {4, 12, {4, -10, 30}}}, 1),
            cap_with(setup, 3, slope, {{4, 12, slope.offset * slope.normal + 15 * normalized({1, 0, -0.364})}}, 3)};
}

const ProvenJob& drilled_job(const std::string& cell_name) {
    static std::map<std::string, ProvenJob> jobs;
    const auto known = jobs.find(cell_name);
    if (known != jobs.end()) return known->second;
    return jobs.emplace(cell_name, made_and_proven(cell_name, rounded_slab(), caps_of_slab)).first->second;
}

using Lines = std::vector<std::string>;

// The file of a job as lines without their ends.
Lines lines_of(const ReadJob& job, const std::string& file) {
    const Bytes& bytes = job.files.at(file);
    Lines lines{""};
    for (const auto byte : bytes) {
        if (byte == '\n') {
            lines.emplace_back();
        } else if (byte != '\r') {
            lines.back() += static_cast<char>(byte);
        }
    }
    lines.pop_back();
    return lines;
}

void put(ReadJob& job, const std::string& file, const Lines& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\r\n";
    job.files.at(file) = {text.begin(), text.end()};
}

// Where a job drills a hole: the LIN lines behind its comment.
struct Run {
    std::string file;
    Lines lines;
    std::vector<std::size_t> moves;
};

Run run_of(const ReadJob& job, std::size_t hole) {
    const std::string comment = ";hole " + std::to_string(hole);
    for (const JobChunk& chunk : job.program->chunks) {
        Run run{chunk.file, lines_of(job, chunk.file), {}};
        auto at = std::find(run.lines.begin(), run.lines.end(), comment);
        if (at == run.lines.end()) continue;
        for (++at; at != run.lines.end() && !at->starts_with(";") && !at->starts_with("PTP") && *at != "END"; ++at) {
            if (at->starts_with("LIN")) run.moves.push_back(static_cast<std::size_t>(at - run.lines.begin()));
        }
        // start, above the foam, at least one peck and back, up; what follows leads to the next hole
        const auto is_start = [&](std::size_t line) {
            return run.lines[line].substr(0, 25) == run.lines[run.moves.front()].substr(0, 25);
        };
        while (run.moves.size() > 5 && !is_start(run.moves.back())) run.moves.pop_back();
        return run;
    }
    ADD_FAILURE() << "no hole " << hole;
    return {};
}

// Adds to a coordinate of a line: "LIN {X 1.00,Y 2.00,Z 3.00}".
std::string moved(const std::string& line, char axis, double by) {
    const std::size_t at = line.find(std::string(1, axis) + " ") + 2;
    const std::size_t end = line.find_first_of(",}", at);
    return line.substr(0, at) + fixed(std::stod(line.substr(at, end - at)) + by, 2) + line.substr(end);
}

double height_of(const std::string& line) {
    return std::stod(line.substr(line.find("Z ") + 2));
}

void shift(ReadJob& job, std::size_t hole, char axis, double by) {
    Run run = run_of(job, hole);
    for (const std::size_t line : run.moves) run.lines[line] = moved(run.lines[line], axis, by);
    put(job, run.file, run.lines);
}

// All moves as deep as the deepest one.
void deepen(ReadJob& job, std::size_t hole, double by) {
    Run run = run_of(job, hole);
    double deepest = 1e9;
    for (const std::size_t line : run.moves) deepest = std::min(deepest, height_of(run.lines[line]));
    for (const std::size_t line : run.moves) {
        if (height_of(run.lines[line]) < deepest + 0.005) run.lines[line] = moved(run.lines[line], 'Z', -by);
    }
    put(job, run.file, run.lines);
}

void leave_out(ReadJob& job, std::size_t hole) {
    Run run = run_of(job, hole);
    for (std::size_t i = run.moves.size() - 2; i >= 2; --i) {
        run.lines.erase(run.lines.begin() + static_cast<std::ptrdiff_t>(run.moves[i]));
    }
    put(job, run.file, run.lines);
}

// Once more, beside its place, by no name.
void drill_again(ReadJob& job, std::size_t hole, double beside) {
    Run run = run_of(job, hole);
    Lines more{";another"};
    for (const std::size_t line : run.moves) {
        std::string own = moved(run.lines[line], 'X', beside);
        if (own.find(",A ") != std::string::npos) own = own.substr(0, own.find(",A ")) + "}";
        more.push_back(own);
    }
    const auto behind = run.lines.begin() + static_cast<std::ptrdiff_t>(run.moves.back()) + 1;
    more.front() = ";hole 9999";
    run.lines.insert(behind, more.begin(), more.end());
    put(job, run.file, run.lines);
}

// The whole run of a hole once more.
void drill_twice(ReadJob& job, std::size_t hole) {
    Run run = run_of(job, hole);
    Lines more;
    for (const std::size_t line : run.moves) more.push_back(run.lines[line]);
    const auto behind = run.lines.begin() + static_cast<std::ptrdiff_t>(run.moves.back()) + 1;
    run.lines.insert(behind, more.begin(), more.end());
    put(job, run.file, run.lines);
}

// The last stroke of a hole once more, `deeper` than it was.
void repeat_last_stroke(ReadJob& job, std::size_t hole, double deeper) {
    Run run = run_of(job, hole);
    const std::size_t last = run.moves[run.moves.size() - 3];
    ASSERT_LT(height_of(run.lines[last]), height_of(run.lines[last - 1]));
    const Lines more{run.lines[last - 1], moved(run.lines[last], 'Z', -deeper)};
    run.lines.insert(run.lines.begin() + static_cast<std::ptrdiff_t>(last) + 1, more.begin(), more.end());
    put(job, run.file, run.lines);
}

// The chunk of a hole with another drill, which the operator is asked for.
void take_drill(ReadJob& job, std::size_t hole, const std::string& from, const std::string& to) {
    const std::string file = run_of(job, hole).file;
    for (JobChunk& chunk : job.program->chunks) {
        if (chunk.file == file) chunk.tool = static_cast<std::uint16_t>(std::stoi(to));
    }
    Lines lines = lines_of(job, job.program->entry);
    for (std::string& line : lines) {
        for (const std::string words : {"\"Put tool ", "\"Measure tool "}) {
            const std::size_t at = line.find(words + from);
            if (at != std::string::npos) line.replace(at + words.size(), from.size(), to);
        }
    }
    put(job, job.program->entry, lines);
}

void give_to_the_hand(ReadJob& job, std::size_t hole) {
    for (JobCap& cap : job.caps) {
        for (JobHole& own : cap.joints[0].holes) {
            if (own.number == hole) own.by_robot = false, own.by_hand = "so it is wanted";
        }
    }
    std::erase(job.program->holes, hole);
}

struct Fault {
    std::string name;
    std::function<void(ReadJob&)> make;
    std::string kind;  // that must be among the findings
    std::string text;  // of the finding
};

std::vector<Fault> faults() {
    return {
        {"hole left out", [](ReadJob& job) { leave_out(job, 1); }, "missing_hole", "hole 1 is not drilled"},
        {"tilted hole left out", [](ReadJob& job) { leave_out(job, 3); }, "missing_hole", "hole 3 is not drilled"},
        {"shifted by 1 mm", [](ReadJob& job) { shift(job, 1, 'X', 1); }, "shifted_hole", "hole 1 is drilled 1.00 mm"},
        {"shifted by 0.3 mm", [](ReadJob& job) { shift(job, 2, 'Y', 0.3); }, "shifted_hole", "hole 2"},
        {"tilted hole shifted", [](ReadJob& job) { shift(job, 3, 'Y', 0.5); }, "shifted_hole", "hole 3"},
        {"2 mm too deep", [](ReadJob& job) { deepen(job, 1, 2); }, "hole_depth", "hole 1 is drilled 18.00 mm deep"},
        {"3 mm too shallow", [](ReadJob& job) { deepen(job, 1, -3); }, "hole_depth", "hole 1 is drilled only 13.00"},
        {"wrong drill", [](ReadJob& job) { take_drill(job, 1, "6", "5"); }, "hole_diameter", "with tool 5 of 8.00 mm"},
        {"a hole too many", [](ReadJob& job) { drill_again(job, 1, -16); }, "extra_hole", "where the job has no hole"},
        {"drilled twice", [](ReadJob& job) { drill_twice(job, 3); }, "repeated_hole", "hole 3 is drilled again"},
        {"the last stroke twice", [](ReadJob& job) { repeat_last_stroke(job, 1, 0); }, "repeated_hole",
         "hole 1 is drilled again"},
        {"a further stroke, deeper", [](ReadJob& job) { repeat_last_stroke(job, 1, 0.5); }, "hole_depth",
         "hole 1 is drilled 16.50 mm deep"},
        {"a hole for the hand", [](ReadJob& job) { give_to_the_hand(job, 2); }, "extra_hole", "drilled by hand"},
        {"a hole through the base", [](ReadJob& job) { deepen(job, 2, 10); }, "hole_depth", "hole 2"},
    };
}

// The manifest describes the changed chunks.
void fill_in(ReadJob& job, const Cell& cell) {
    std::vector<ProgramFile> files;
    for (const std::string& name : job.program->files) {
        files.push_back({name, {job.files.at(name).begin(), job.files.at(name).end()}});
    }
    const std::string& entry = job.program->entry;
    const auto read = summarise_chunks(read_krl(files, entry.substr(0, entry.find('.')), called_programs(cell)));
    for (std::size_t i = 0; i < read.size(); ++i) {
        JobChunk& chunk = job.program->chunks[i];
        chunk = {chunk.file,     chunk.tool,  chunk.orientation, read[i].moves,
                 read[i].length, read[i].box, read[i].first,     read[i].last};
    }
}

// Its robot drills all three holes.
struct DrilledJobsOf : ::testing::TestWithParam<std::string> {};
struct FaultsOfDrilledJobs : ::testing::TestWithParam<std::string> {};

TEST_P(DrilledJobsOf, AreProvenAsTheyWereMade) {
    const ProvenJob& proven = drilled_job(GetParam());
    for (const ProofFinding& finding : proven.verdict.findings) ADD_FAILURE() << describe(finding);
    EXPECT_TRUE(proven.verdict.is_positive);
    for (const JobHole& hole : holes_of(proven.job.caps)) {
        EXPECT_TRUE(hole.by_robot) << hole.number << ": " << hole.by_hand;
    }
    EXPECT_EQ(proven.job.program->holes, (std::vector<std::size_t>{1, 2, 3}));
    std::map<std::string, double> figures;
    for (const ProofFigure& figure : proven.verdict.figures) figures[figure.key] = figure.value;
    EXPECT_EQ(figures["holes_due"], 3);
    EXPECT_EQ(figures["holes_drilled"], 3);
    EXPECT_LE(figures["max_hole_offset_mm"], 0.02);
}

TEST(DrilledJobs, AGantryDrillsStraightDownAndLeavesTheTiltedHoleToTheHand) {
    const ProvenJob& proven = drilled_job("gantry-3axis");
    for (const ProofFinding& finding : proven.verdict.findings) ADD_FAILURE() << describe(finding);
    EXPECT_TRUE(proven.verdict.is_positive);
    EXPECT_EQ(proven.job.program->holes, (std::vector<std::size_t>{1, 2}));
    const std::vector<JobHole> holes = holes_of(proven.job.caps);
    ASSERT_EQ(holes.size(), 3U);
    EXPECT_TRUE(holes[0].by_robot && holes[1].by_robot);
    EXPECT_FALSE(holes[2].by_robot);
    EXPECT_NE(holes[2].by_hand, "");
    for (const ProofFigure& figure : proven.verdict.figures) {
        if (figure.key != "holes_due" && figure.key != "holes_drilled") continue;
        EXPECT_EQ(figure.value, 2) << figure.key;
    }
}

TEST_P(FaultsOfDrilledJobs, AreAllFound) {
    const ProvenJob& proven = drilled_job(GetParam());
    ASSERT_EQ(proven.job.program->holes, (std::vector<std::size_t>{1, 2, 3}));
    for (const Fault& fault : faults()) {
        ReadJob job = proven.job;
        fault.make(job);
        fill_in(job, proven.cell.cell);
        const JobVerdict verdict = judged(job, proven.cell);
        const auto found = std::find_if(verdict.findings.begin(), verdict.findings.end(), [&](const ProofFinding& f) {
            return f.kind == fault.kind && f.text.find(fault.text) != std::string::npos;
        });
        EXPECT_FALSE(verdict.is_positive) << fault.name;
        std::string all;
        for (const ProofFinding& f : verdict.findings) all += f.kind + ": " + describe(f) + "\n";
        ASSERT_NE(found, verdict.findings.end()) << fault.name << " is seen as\n" << all;
        EXPECT_TRUE(fault.kind == "missing_hole" || found->line > 0) << "the line of the fault is named";
        std::printf("%s: %s\n", fault.name.c_str(), describe(*found).c_str());
    }
}

struct Slab {
    Cell cell = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
    Piece piece = rounded_slab();
    std::unique_ptr<Setups> setups;

    PiecePrograms programs() {
        setups = std::make_unique<Setups>(cell);
        setups->place({&piece, 1}, {});
        const PlacedSetup& piece_setup = setups->placed(piece);
        return make_programs(piece, piece_setup, {1}, cell, caps_of_slab(piece_setup.setup()), {});
    }
};

std::vector<JobHole> holes_in(const PiecePrograms& programs) {
    std::vector<JobHole> holes;
    for (const DrawnCap& drawn : programs.caps) {
        for (const JobHole& hole : drawn.cap.joints[0].holes) holes.push_back(hole);
    }
    return holes;
}

TEST(DrilledJobs, AProgramThatCannotBeMadeWithTheHolesIsMadeWithoutThem) {
    Slab slab;
    for (CuttingTool& tool : slab.cell.machine->tools) {
        if (is_drill(tool)) tool.mass_kg = 20'000;  // more than a program can say
    }
    const PiecePrograms programs = slab.programs();
    ASSERT_EQ(programs.parts.size(), 1U) << programs.none_because;
    EXPECT_TRUE(programs.parts[0].proof.is_proven());
    EXPECT_TRUE(programs.parts[0].input.program.holes.empty());
    EXPECT_TRUE(programs.parts[0].input.program.drilling.empty());
    for (const JobHole& hole : holes_in(programs)) {
        EXPECT_FALSE(hole.by_robot);
        EXPECT_EQ(hole.by_hand.find("the program cannot drill: "), 0U) << hole.by_hand;
    }
}

TEST(DrilledJobs, OnlyTheHolesThatTheProgramCannotDrillAreForTheHand) {
    Slab slab;
    for (CuttingTool& tool : slab.cell.machine->tools) {
        if (is_drill(tool) && tool.diameter == 6) tool.mass_kg = 20'000;
    }
    const PiecePrograms programs = slab.programs();
    ASSERT_EQ(programs.parts.size(), 1U) << programs.none_because;
    for (const ProofFinding& finding : programs.parts[0].proof.findings) ADD_FAILURE() << describe(finding);
    EXPECT_EQ(programs.parts[0].input.program.holes, (std::vector<std::size_t>{2, 3}));
    const std::vector<JobHole> holes = holes_in(programs);
    ASSERT_EQ(holes.size(), 3U);
    EXPECT_EQ(holes[0].by_hand.find("the program cannot drill: "), 0U) << holes[0].by_hand;
    EXPECT_NE(holes[0].by_hand.find("M = 20015"), std::string::npos) << holes[0].by_hand;
    EXPECT_TRUE(holes[1].by_robot && holes[2].by_robot);
}

TEST(DrilledJobs, WithoutDrillsAllHolesAreForTheHand) {
    Slab slab;
    std::erase_if(slab.cell.machine->tools, [](const CuttingTool& tool) { return is_drill(tool); });
    const PiecePrograms programs = slab.programs();
    ASSERT_EQ(programs.parts.size(), 1U) << programs.none_because;
    EXPECT_TRUE(programs.parts[0].proof.is_proven());
    std::vector<std::string> why;
    for (const JobHole& hole : holes_in(programs)) why.push_back(hole.by_hand);
    EXPECT_EQ(why, (std::vector<std::string>{"the cell has no drill of 6.0 mm", "the cell has no drill of 4.0 mm",
                                             "the cell has no drill of 4.0 mm"}));
}

TEST(DrilledJobs, EveryPartDrillsItsHolesAndAllOfThemAll) {
    Slab slab;
    slab.cell.machine->program.memory_bytes = 30'000;
    const PiecePrograms programs = slab.programs();
    ASSERT_GE(programs.parts.size(), 2U) << programs.none_because;
    std::vector<std::size_t> all;
    std::size_t with_holes = 0;
    for (const ProvenProgram& part : programs.parts) {
        const std::vector<std::size_t>& own = part.input.program.holes;
        all.insert(all.end(), own.begin(), own.end());
        with_holes += own.empty() ? 0 : 1;
        for (const ProofFinding& finding : part.proof.findings) ADD_FAILURE() << describe(finding);
    }
    std::sort(all.begin(), all.end());
    EXPECT_EQ(all, (std::vector<std::size_t>{1, 2, 3}));
    std::printf("%zu parts, %zu of them drill\n", programs.parts.size(), with_holes);
}

INSTANTIATE_TEST_SUITE_P(Arms, DrilledJobsOf,
                         ::testing::Values("kr60-ha", "kr120-r2500-pro-rotary", "irb6640-185-2.8"));
INSTANTIATE_TEST_SUITE_P(Kuka, FaultsOfDrilledJobs, ::testing::Values("kr60-ha", "kr120-r2500-pro-rotary"));

TEST(DrilledJobs, ARestartDrillsTheHolesOfItsChunks) {
    const ProvenJob& whole = drilled_job("kr60-ha");
    const std::vector<JobChunk>& chunks = whole.job.program->chunks;
    const std::string source = "A.qjob";
    std::set<std::size_t> counts;
    for (std::size_t chunk = chunks.size() - 1; chunk > 0 && chunk + 4 > chunks.size(); --chunk) {
        const RestartJob made = make_restart({whole.job, source, whole.cell.cell, chunk, 0});
        EXPECT_TRUE(made.proof.is_proven()) << made.proof.findings.front().text;
        const std::vector<std::size_t> holes = parse_job(made.file, made.name).program->holes;
        counts.insert(holes.size());
        for (const std::size_t hole : whole.job.program->holes) {
            const auto own = std::ranges::find(chunks, run_of(whole.job, hole).file, &JobChunk::file);
            EXPECT_EQ(std::ranges::count(holes, hole), own - chunks.begin() >= std::ptrdiff_t(made.chunk) ? 1 : 0);
        }
        EXPECT_EQ(made.proof.figure("holes_due"), static_cast<double>(holes.size()));
    }
    EXPECT_GT(counts.size(), 1U);
}

}  // namespace
}  // namespace qchopper
