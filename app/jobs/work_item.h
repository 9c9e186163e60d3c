// A piece as it was cut and set up, in one file: all that its programs are made from, and what its job says besides.
// Any machine with the same build can make them, without the project, its scan and its lock.
//
// A file NAME.qitem, sealed by a SHA-256 at its end (docs/developer/formats/work-folder.md). What is read is what was
// written, to the bit (tests/app/jobs/work_item_test.cpp), so that programs are the same wherever they are made.

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/jobs/setups.h"
#include "base/context.h"
#include "base/files/file.h"
#include "cam/job/job.h"
#include "cam/toolpath/toolpath_settings.h"

namespace qchopper {

// What is known of the programs of a piece once they are made, or once it is known that there are none.
enum class ProgramOutcome { proven, refused, none };

struct WorkedPiece {
    std::string name;
    ProgramOutcome outcome = ProgramOutcome::none;
    std::string none_because = {};     // without a full stop; of `none`
    bool was_kept = false;             // an earlier run made them
    double time_s = 0;                 // machine time of all parts
    bool is_machine_refusing = false;  // of `none`: the arm does not follow the toolpath
};

constexpr const char* item_ending = ".qitem";

struct WorkItem {
    JobInput job;             // before its program; without what says nothing about it
    PlacedSetup piece_setup;  // that of the job, with the other ways to lay the piece
    Bytes cell_file;          // its text
    Cell cell;                // read from it, with all its tools
    FineTools fine = FineTools::worthwhile;
    // Name of the file that its programs are kept in (kept_programs.h); empty: it gets none, because it does not fit
    // the cell or the saw alone makes it.
    std::string result;
    // Whether there was a result of every piece when the items were written: those that the arm refused have been
    // changed if anything helps.
    bool is_settled = false;
    double effort = 0;  // program_effort(): a machine makes so and so much of it per second; 0 without a program
    bool has_program() const { return !result.empty(); }
};

// What a job of a piece leads to. `cell_file` is the text of the project's cell file, `result` the name of
// programs_file(), empty for a piece that gets none. Precondition: the setup fits, or there is no result.
WorkItem work_item(const JobInput& job, const PlacedSetup& piece_setup, const Bytes& cell_file, FineTools fine,
                   const std::string& result);

// O(bytes).
Bytes to_bytes(const WorkItem& item);
// Throws InputError (mesh) naming `source` if the bytes are no item, cut short or damaged, or of another build than
// `program_version` (tests/fuzz/fuzz_item.cpp). O(bytes).
WorkItem item_from(const Bytes& bytes, const std::filesystem::path& source, const std::string& program_version);

// Makes the programs of an item and keeps them in the folder of results, unless a whole result is there. Two processes
// may work on one item at once. Precondition: has_program(). Throws Cancelled; std::logic_error if a result that came
// meanwhile has other bytes: both are kept then, the second as NAME.second.
WorkedPiece work_on(const WorkItem& item, const std::filesystem::path& results, const Context& context);

// Copies the result of an item from one folder to another, which is made. Precondition: it is there. Throws what
// read_file and write_file throw.
void copy_result(const WorkItem& item, const std::filesystem::path& from, const std::filesystem::path& to);

// What is known of the result of an item; nothing if there is none, or it is damaged.
std::optional<WorkedPiece> result_of(const WorkItem& item, const std::filesystem::path& results);

}  // namespace qchopper
