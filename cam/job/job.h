// The values of a job: what goes into the job file of one piece, and what is read back from it.
//
// Lengths in mm, in setup coordinates (cam/setup/setup.h) where nothing else is stated. write_job.h writes them,
// read_job.h reads them (tests/cam/job/job_file_test.cpp).

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/files/file.h"
#include "cam/cell/cell.h"
#include "cam/job/job_cap.h"
#include "cam/job/job_program.h"
#include "cam/job/ticket.h"
#include "cam/setup/placement/machine_reachability.h"
#include "cam/setup/setup.h"
#include "cam/setup/stock_fit.h"
#include "segment/cut/piece.h"

namespace qchopper {

constexpr int job_schema_version = 8;

// Precondition of all functions that take it: piece.mesh is not null, setup.block.stock is an index in cell.stock, so
// are those of the alternatives, the envelope has a margin, states are empty or one per triangle, and max_unreachable
// is 0..1.
struct JobInput {
    Piece piece;                 // in piece coordinates
    std::uint16_t piece_no = 1;  // 1..piece_count
    std::uint16_t piece_count = 1;
    std::string program_version;  // "0.1.0"
    Uuid project_id{};            // first 16 bytes of a SHA-256 over scan and decisions
    Sha256 scan_sha256;
    Cell cell;
    Setup setup;
    StockFit stock_fit;
    std::vector<Setup> alternatives;                // the other ways to lay the piece, best first
    std::vector<SurfaceState> states;               // per triangle of the piece; empty: not known
    double max_unreachable = 1;                     // share beyond which dispatch asks for the operator's word
    std::vector<std::string> warnings;              // of the project: "scaled by 0.5 on request"
    MachineReachability machine_reachability = {};  // of the setup
    std::optional<ProgramInput> program = {};
    std::vector<DrawnCap> caps = {};                        // that are joined to other pieces, by their cuts
    std::string no_program_because = "none was asked for";  // for people; not used if there is a program
};

// Another way to lay the piece, as far as a person needs it to choose; mm, mm3.
struct Alternative {
    int base_number = 0;
    std::string base_description;
    AccessMethod method = AccessMethod::sampled;
    double unreachable_share = 0;
    double foam_mm3 = 0;           // mapped only
    double rest_material_mm3 = 0;  // mapped only
    Vec3 block;                    // its size
    std::uint32_t directions = 0;
    bool operator==(const Alternative&) const = default;
};

// A file in the job file, as the manifest lists it.
struct JobEntry {
    std::string name;
    std::uint64_t size = 0;  // bytes
    Sha256 sha256;
    bool operator==(const JobEntry&) const = default;
};

// A job as its manifest tells it, and, when a job file was read and passed all checks of parse_job, with its files.
struct ReadJob {
    std::string piece;
    std::uint16_t piece_no = 0;
    std::uint16_t piece_count = 0;
    std::string program_version;
    Uuid project_id{};
    Sha256 scan_sha256;
    std::string cell;  // its name
    std::uint16_t cell_id = 0;
    Setup setup;  // as it was written
    std::vector<Alternative> alternatives;
    double max_unreachable = 0;                 // share, 0..1
    std::string block_name;                     // in the cell's list of stock
    Material material = Material::unspecified;  // of the block
    double margin = 0;                          // of foam around the piece
    std::vector<double> foam_at_faces;          // by BlockFace; empty: no face is flush
    std::vector<HalfSpace> half_spaces;         // in piece coordinates
    std::vector<JobCap> caps;                   // that are joined to other pieces, by their cuts
    StockFit stock_fit;
    bool is_arm_checked = false;      // whether envelope.json tells of poses
    bool holds_poses = true;          // whether the machine holds all of them; true where they are not checked
    std::vector<Pose> setup_in_cell;  // of a rotary table one per direction, else one
    std::uint64_t faces = 0;
    double volume_mm3 = 0;
    std::optional<JobProgram> program;
    std::string no_program_because;     // empty where there is one
    std::vector<std::string> warnings;  // of the project
    std::vector<JobEntry> entries;      // every file but the manifest
    TicketTemplate ticket;
    std::map<std::string, Bytes> files;  // all by name, the manifest too
    std::uint32_t file_size = 0;         // of the .qjob itself
    Sha256 file_sha256;
};

// The state "unreachable": the tool leaves more of the surface than the limit allows, and dispatch asks for the
// operator's word. Otherwise the state is "ready".
inline bool is_unreachable(const Setup& setup, double max_unreachable) {
    return setup.access.exceeds(max_unreachable);
}

}  // namespace qchopper
