// The robot program of a job, as the manifest describes it, and what the proof of it found, as the setup sheet shows
// it.
//
// Values; lengths in mm in the program's base frame, which is the setup frame. The texts themselves are entries of the
// job file (docs/developer/formats/programs.md explains them); what is stated of a chunk is what a reader finds in its
// text.

#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/box.h"
#include "base/files/file.h"
#include "base/sha256.h"
#include "cam/cell/cell.h"
#include "cam/cell/machine_time.h"
#include "cam/setup/drill_orientation.h"

namespace qchopper {

// A file of moves of one tool from one direction.
struct JobChunk {
    std::string file;
    std::uint16_t tool = 0;       // its number in the cell file
    std::size_t orientation = 0;  // index in SurfaceAccess::orientations, with JobProgram::drilling behind them
    std::uint64_t moves = 0;      // straight ones
    double length_mm = 0;         // of the straight moves
    Box box;                      // of the points that the tip moves to
    Vec3 first;
    Vec3 last;
    bool operator==(const JobChunk&) const = default;
};

// A piece whose program exceeds the controller's memory is milled by several jobs in one clamping: its parts.
struct JobPart {
    std::uint16_t number = 1;      // 1..count
    std::uint16_t count = 1;       // 1: undivided
    std::optional<Sha256> before;  // of the job file of part number - 1; nothing for the first part
    bool operator==(const JobPart&) const = default;
};

// A job that goes on where another one was stopped: its chunks are the last ones of that job, and it carries the stock
// that the chunks before them leave.
struct JobRestart {
    Sha256 of;                        // of the job file that it goes on with
    std::uint32_t chunks_before = 0;  // of that job's chunks, that are not carved again
    bool operator==(const JobRestart&) const = default;
};

// Cuts that the program leaves out, because no arm configuration takes them.
struct MovesLeftOut {
    double length_mm = 0;
    std::string because;  // of the first ones, without a full stop; empty: none is left out
    bool operator==(const MovesLeftOut&) const = default;
};

// "no arm posture reaches 6 mm of its cuts: ...", without a full stop. Empty if none is left out.
std::string describe(const MovesLeftOut& moves);

// A ball-ended tool that may be used and that the program does not use along a direction of the setup, and why.
struct ToolLeftOut {
    std::optional<std::uint16_t> tool;       // CuttingTool::number; nothing: no tool at all
    std::optional<std::size_t> orientation;  // index in SurfaceAccess::orientations; nothing: along none of them
    std::string because;                     // without a full stop
    bool operator==(const ToolLeftOut&) const = default;
};

struct JobProgram {
    Dialect dialect = Dialect::krl;
    std::string entry;               // the file that is started
    std::vector<std::string> files;  // all of the program, in the order in which they are loaded
    std::vector<JobChunk> chunks;    // in the order in which they run; at least one
    JobPart part;
    std::optional<JobRestart> restart;       // nothing: it begins in the block, or where the part before it ended
    std::vector<DrillOrientation> drilling;  // of all parts: directions behind those of the setup
    std::vector<std::size_t> holes;          // numbers of those that this program drills, ascending
    double scallop_mm = 0;                   // scallop height that finishing was made for
    double time_s = 0;                       // estimated, accelerations and tool changes included
    std::vector<ToolLeftOut> left_out;       // of all parts
    MovesLeftOut moves_left_out;             // of all parts
    // Whether its job carries the stock in which it begins (stock.bin).
    bool has_stock() const { return part.number > 1 || restart.has_value(); }
    bool operator==(const JobProgram&) const = default;
};

// One figure of the proof: "largest gouge", 0.08, "mm".
struct ProofFigure {
    std::string key;  // "max_gouge_mm", for JSON
    std::string name;
    double value = 0;
    std::string unit;
    int decimals = 2;
    bool operator==(const ProofFigure&) const = default;
};

// What speaks against a job.
struct ProofFinding {
    std::string kind;      // "rapid_in_foam"
    std::string file;      // of the program; empty: of no file
    std::size_t line = 0;  // from 1; 0: of the whole file
    std::string text;      // one sentence without a full stop
    bool operator==(const ProofFinding&) const = default;
};

// "qc_1_002.src line 17: the tip moves at 150 mm/s while it cuts, more than 120".
std::string describe(const ProofFinding& finding);

constexpr std::size_t max_listed_findings = 100;

// The result of a proof, as the verdict, the setup sheet and the reports show it.
struct ProofResult {
    std::vector<ProofFigure> figures;  // of the replay; none where there was nothing to replay
    std::vector<MachineTime> time;     // in the order of first use
    std::vector<ProofFinding> findings;
    std::size_t findings_left_out = 0;  // beyond those listed
    std::vector<std::string> notes;     // what is to be known and speaks not against it: as findings, one sentence each
    bool is_proven() const { return findings.empty() && !figures.empty(); }
    double figure(std::string_view key) const;  // 0 if there is none
    bool operator==(const ProofResult&) const = default;
};

// What goes into a job with its program.
struct ProgramInput {
    JobProgram program;
    std::map<std::string, std::string> texts;  // of all its files, by name
    std::vector<std::uint16_t> tools;          // numbers, in the order in which they are used
    ProofResult proof;
    Bytes deviation_picture;  // PNG; empty: none
    Bytes stock;              // stock.bin, where the program has_stock()
};

}  // namespace qchopper
