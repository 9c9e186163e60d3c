// The command line as values: one struct per command, in which nothing stands for an option that is not given.
//
// parse_arguments() has checked single values (option_values.h); check_arguments.h checks which options go together.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "app/dispatch/dispatch_project.h"
#include "app/dispatch/dry_run.h"
#include "app/engine/export_pieces.h"
#include "app/engine/setup_project.h"
#include "app/jobs/entered/entered_values.h"

namespace qchopper {

struct SampleArguments {
    std::string specimen;
    std::size_t faces = 100'000;
    int holes = 0;
    int pen_grooves = 0;
    std::filesystem::path out;
};

struct FuseArguments {
    std::filesystem::path list;
    std::optional<double> voxel;
    std::filesystem::path out;
};

struct InspectArguments {
    std::filesystem::path scan;
    std::optional<std::string> units;
    bool deep = false;
};

// How a scan becomes a solid, for every command that imports one.
struct RepairChoiceArguments {
    bool size_ok = false;  // any size of the scan is taken
    std::optional<double> snap_borders_mm;
    std::optional<std::string> fill;  // auto | flat | fair | none
    bool resolve_self_intersections = false;
    bool smooth_pen_grooves = false;
    std::optional<double> alpha_wrap_mm;
};

struct RepairArguments : RepairChoiceArguments {
    std::filesystem::path scan;
    std::filesystem::path out;
    std::optional<std::string> units;
    std::optional<double> scale;
    std::optional<std::string> fragments;  // keep | drop
    bool keep_self_intersections = false;
    std::optional<double> groove_width;  // mm, of the widest pen groove
    std::optional<double> groove_depth;  // mm, of the deepest
    std::vector<std::string> skipped;    // names of steps
};

// The settings of a new project. Stop rules and beam are also those of a search that goes on.
struct ProjectArguments : RepairChoiceArguments {
    std::filesystem::path input;  // a scan, or a project folder to go on with
    std::optional<std::string> units;
    std::optional<double> scale;
    std::optional<std::filesystem::path> cell;
    std::vector<std::uint16_t> tools;   // numbers
    std::optional<double> finest_tool;  // mm
    std::optional<std::string> fine;    // auto | all | none
    std::optional<std::string> preset;
    std::optional<int> min_cuts;
    std::optional<std::size_t> max_faces;
    std::optional<std::string> max_obb;  // option_values.h reads it
    bool fits_cell = false;
    std::optional<double> max_unreachable;  // 0..1
    bool count_narrow = false;
    std::optional<int> max_cuts;
    std::optional<std::string> stop;          // any | all
    std::optional<std::string> fragility;     // thinness | thesis | binary
    std::optional<std::string> print_volume;  // option_values.h reads it
    std::optional<std::string> utilization;   // cut | whole
    std::optional<std::string> connector;     // spread | ratio
    std::vector<std::string> forbidden;       // objectives
    std::optional<std::string> weights;       // option_values.h reads it
    std::optional<std::string> structure;     // option_values.h reads it
    std::optional<int> beam;
    std::optional<double> time_limit_s;
    std::optional<std::string> fragments;  // keep | drop
    std::optional<double> fragment_volume_mm3;
    std::optional<std::string> normals;  // box | sphere
    std::optional<int> offsets;
    std::optional<double> offset_step_mm;
    std::optional<std::filesystem::path> planes;
    std::optional<std::string> propose;  // option_values.h reads it
    bool symmetry = false;
    std::optional<std::filesystem::path> no_cut;
    std::optional<std::filesystem::path> ignore_surface;
    bool ignore_inside = false;
    std::optional<std::string> discard;  // option_values.h reads it
    std::optional<std::filesystem::path> out;
};

struct PrepareArguments : ProjectArguments {
    bool programs = false;
    bool no_programs = false;
    bool items = false;
};

struct SegmentArguments : ProjectArguments {
    // What to do: one of these, or none to see the state of the project.
    bool step = false;
    std::optional<std::size_t> accept;   // a place in the ranking, from 1
    std::optional<std::string> plane;    // nx,ny,nz,d
    std::optional<std::string> preview;  // a place, or nx,ny,nz,d
    bool undo = false;
    bool redo = false;
    bool reset = false;
    bool goes_on = false;                           // --auto
    std::optional<std::filesystem::path> plan;      // to write
    std::optional<std::filesystem::path> replayed;  // a plan to replay
    std::optional<std::string> regions;             // a method; `out` is the file to write
    // Options of these.
    std::optional<std::string> expected_plane;  // nx,ny,nz,d
    bool preview_setups = false;                // --setups
    std::optional<std::string> tried_weights;   // as ProjectArguments::weights
    std::optional<std::string> piece;
    std::optional<std::size_t> top;
    bool write_pieces = false;
};

struct ExplainArguments {
    std::filesystem::path project;
    std::optional<int> cut;                    // the last one
    std::optional<std::filesystem::path> out;  // of the plot
};

struct GuideArguments {
    std::filesystem::path project;
};

struct ExportArguments : ExportRequest {
    std::filesystem::path project;
};

struct WorkArguments {
    std::vector<std::filesystem::path> inputs;  // projects, or files of items
    std::optional<std::string> shard;           // option_values.h reads it
    bool status = false;
    bool has_retry = false;  // of pieces that have failed three times too
};

struct SubmitArguments {
    std::filesystem::path project;
    std::string engine = "slurm";  // or local
    std::optional<std::size_t> shards;
    std::optional<double> memory_mb;  // of all processes together, local
    bool has_retry = false;           // of pieces that have failed three times too
    bool is_only_written = false;
    std::vector<std::string> options;  // of sbatch
};

struct GatherArguments {
    std::filesystem::path project;
    bool make_missing = false;
};

struct CellsListArguments {
    std::filesystem::path folder;  // empty: cells, or that of the ready cells where there is none
};

struct CellsShowArguments {
    std::filesystem::path file;
    std::optional<std::filesystem::path> out;      // picture of the reach
    std::optional<std::filesystem::path> drawing;  // of the arm's lengths
};

struct CellsRobotsArguments {};

struct CellsNewArguments {
    std::string robot;
    std::optional<std::string> name;           // of the cell; that of the file
    int id = 1;                                // CELL_ID
    std::optional<std::filesystem::path> out;  // ROBOT.toml
};

struct CellsReachArguments {
    std::filesystem::path file;
    double tilt_deg = 0;
    std::optional<std::string> block;  // option_values.h reads it; the largest of the cell
};

struct CellsCheckArguments {
    std::filesystem::path file;
    std::vector<std::string> poses;  // option_values.h reads them
};

struct SetupArguments : SetupRequest {
    std::filesystem::path project;
};

struct VerifyArguments {
    std::filesystem::path input;  // a job file, or a project folder
    std::optional<std::filesystem::path> cell;
    std::optional<std::string> piece;
    std::optional<std::filesystem::path> trusted;  // list of trusted keys
    EnteredValues entered;                         // --base and --tool
};

// How a private key is named.
struct SigningArguments {
    std::optional<std::string> key;  // a name in the folder of keys, or a path
    std::optional<int> passphrase_fd;
};

struct KeysArguments {
    std::string action;  // make, show, trust, revoke, sign, check
    std::string key;     // make: its name; trust: the file of a public key; revoke: name or id
    std::optional<std::string> name;
    std::optional<std::filesystem::path> list;
    bool no_passphrase = false;
    std::optional<int> passphrase_fd;
    SigningArguments signing;
    std::vector<std::filesystem::path> inputs;  // sign: a project or a job file; check: job files
    std::optional<std::uint16_t> cell_id;
};

struct DryRunArguments : DryRunRequest {};

struct CellSimArguments {
    std::string listen = "127.0.0.1:15020";
    std::vector<std::string> allow;  // numeric addresses that may connect; loopback always may
    std::filesystem::path drop;
    std::string consent = "auto";
    std::optional<std::filesystem::path> store;
    std::optional<std::filesystem::path> cell;
    double speed = 1;
    std::optional<std::filesystem::path> trusted;  // list of trusted keys
    std::optional<std::filesystem::path> script;
    std::optional<std::filesystem::path> picture;  // of the block as it stands when the cell ends
    bool list_faults = false;
};

struct DispatchArguments : DispatchRequest {
    SigningArguments signing;
};

// Which cell: by its address, or by the file that names it.
struct CellChoiceArguments {
    std::optional<std::string> to;
    std::optional<std::filesystem::path> cell;
};

struct JournalArguments {
    std::filesystem::path folder;  // of the journal; empty: list all
    bool shows = true;             // else it is only verified
};

struct JournalJobsArguments {
    std::vector<std::filesystem::path> journals;  // empty: all
    std::optional<std::string> since;             // a day or time, UTC
    bool is_csv = false;
};

struct JournalExportArguments {
    std::filesystem::path journal;
    std::string before;  // a day or time, UTC
    std::filesystem::path out;
};

struct CellControlArguments : CellChoiceArguments {
    std::string action;  // status, hold, unhold, stop, abort, clear, reset, take-over, accept-store
    std::optional<std::uint32_t> code;
    bool yes = false;
};

struct CellCheckArguments {
    std::string to;    // HOST:PORT
    bool yes = false;  // to every question
};

struct ServeArguments {
    std::filesystem::path folder = ".";  // of scans and projects, or a project
    std::string listen = "127.0.0.1:8720";
    std::string dispatch = "simulated";  // none | simulated | real
    bool is_read_only = false;
    std::optional<std::string> to;              // HOST:PORT of the cell; nothing: as the cell file of each project says
    std::optional<std::filesystem::path> drop;  // of that cell
    bool opens = false;                         // in the browser of the desktop
    bool has_simulator = false;                 // with a simulated cell of its own
    std::vector<std::string> hosts;             // more names of this server
    std::optional<std::filesystem::path> key_file;
};

// The process that holds a project for serve.
struct ConsoleWorkerArguments {
    std::filesystem::path project;
};

// What serve draws of a scan.
struct ConsoleMeshArguments {
    std::filesystem::path scan;
    std::filesystem::path folder;  // where it is kept
};

// What a person has painted in the page of serve, as files.
struct ConsolePaintArguments {
    std::filesystem::path scan;
    std::filesystem::path strokes;
    std::filesystem::path folder;
    std::optional<std::string> units;
};

// A job as serve replays it.
struct ConsoleReplayArguments {
    std::filesystem::path project;
    std::string piece;
    std::uint16_t part = 1;
};

struct SchemaArguments {
    std::string document;  // manifest, envelope, ticket, verdict, project
};

struct Arguments {
    bool json = false;  // for the option parser only; run.cpp reads it before
    bool quiet = false;
    std::string progress;  // json; as `json` above; empty: as a line on a terminal
    bool timings = false;
    std::optional<std::size_t> threads;
    std::variant<SampleArguments, FuseArguments, InspectArguments, RepairArguments, PrepareArguments, SegmentArguments,
                 ExplainArguments, GuideArguments, ExportArguments, CellsListArguments, CellsShowArguments,
                 CellsRobotsArguments, CellsNewArguments, CellsCheckArguments, CellsReachArguments, SetupArguments,
                 WorkArguments, SubmitArguments, GatherArguments, VerifyArguments, KeysArguments, DryRunArguments,
                 CellSimArguments, DispatchArguments, JournalArguments, JournalJobsArguments, JournalExportArguments,
                 CellControlArguments, CellCheckArguments, SchemaArguments, ServeArguments, ConsoleWorkerArguments,
                 ConsoleMeshArguments, ConsolePaintArguments, ConsoleReplayArguments>
        command;
};

// Reads the command line. Nothing if help or version was asked for, which is then printed on stdout. Throws InputError
// (use) for unknown options and commands, missing ones, and wrong values; which options go together is not checked
// (check_arguments.h).
std::optional<Arguments> parse_arguments(int argc, const char* const* argv);

// An option, or an argument without a name.
struct OptionRow {
    std::vector<std::string> names;  // "-o", "--out", or "SCAN"
    std::string about;
    bool takes_value = false;
    bool is_required = false;
};

struct CommandRow {
    std::string command;  // "cells show"
    std::string about;
    std::vector<OptionRow> arguments;
    std::vector<OptionRow> options;
};

// The commands that --help lists, in its order. Completions, the index of manual pages and tests are made of it.
std::vector<CommandRow> command_table();

}  // namespace qchopper
