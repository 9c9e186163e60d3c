// A project: a scan, settings, the operator's decisions, and what follows from them.
//
// Values only; lengths in mm about the scan's centre. project_folder.h keeps a project on disk, open_project.h makes it
// advance. Scan, settings and history give the same pieces again, bit for bit (tests/app/store/project_test.cpp).

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/store/cut_review.h"
#include "app/store/decisions.h"
#include "base/sha256.h"
#include "cam/setup/block_placement.h"
#include "segment/import/import_scan.h"
#include "segment/repair/options.h"
#include "segment/search/search.h"
#include "segment/structure/stress.h"

namespace qchopper {

enum class FragmentChoice { keep, drop };  // keep: written to pieces/fragments.ply; drop: only listed

// Which scan, and how its numbers became millimetres.
struct ScanSource {
    std::filesystem::path path;  // absolute
    Sha256 sha256;               // of the file, and of the files that belong to it
    Unit unit = Unit::mm;
    double scale = 1;
    Vec3 centre;  // mm, subtracted from all points
    std::size_t faces = 0;
    double volume_mm3 = 0;
    std::vector<std::string> warnings = {};  // of the import
    RepairChoices repair = {};               // how it was made a solid
    bool operator==(const ScanSource&) const = default;
};

// Surface that may stay as it is (ignored_surface.h).
struct IgnoredSurface {
    std::filesystem::path painted;  // absolute: the file that marks it; empty: none
    bool inside = false;            // what lies inside the scan too
    double share = 0;               // of the imported scan's area
    Sha256 sha256;                  // of the flags in the folder
    bool operator==(const IgnoredSurface&) const = default;
};

// Surface through which no candidate goes (no_cut_surface.h).
struct NoCutSurface {
    std::filesystem::path painted;  // absolute: the file that marks it
    std::size_t points = 0;         // of the imported scan
    Sha256 sha256;                  // of the points in the folder
    bool operator==(const NoCutSurface&) const = default;
};

// What the project records of a piece or a fragment. Derived from scan and cuts; kept for readers of the file.
struct SolidRecord {
    std::string name;      // empty for a fragment
    std::int32_t cut = 0;  // the cut that made it; 0: it was in the scan
    std::size_t faces = 0;
    double volume_mm3 = 0;
    Vec3 centre;
    bool operator==(const SolidRecord&) const = default;
};

// A job file as it was written, with which dispatch compares the file in the folder.
struct WrittenJob {
    std::string piece;
    Sha256 sha256;           // of the whole file
    std::string project_id;  // 32 hexadecimal digits, as in the job itself
    std::uint16_t part = 1;  // of a piece that several jobs mill in one clamping
    // Where the block stands, if the arm could not follow the toolpath where its poses alone had it.
    std::optional<BlockPlacement> place = {};
    bool operator==(const WrittenJob&) const = default;
};

enum class Stage {
    cutting,  // cuts may follow; there are no outputs, or those of a search that ran out of time
    cut,      // the search has ended and the pieces are written
    done      // pieces, jobs and pictures are written
};

struct Project {
    ScanSource scan;
    std::optional<IgnoredSurface> ignored;
    std::optional<StructureOptions> load;  // under which the scan is to stand; nothing: structure has no weight
    std::optional<NoCutSurface> no_cut;
    std::string preset;       // empty: none
    SearchSettings settings;  // with the weights in force
    FragmentChoice fragments = FragmentChoice::keep;
    Stage stage = Stage::cutting;
    std::optional<EndReason> end_reason;  // of the search; nothing: it has not ended
    std::string ended_because;            // the same as a sentence with its figure
    std::vector<RevertedTrial> reverted;  // of that search: pieces that no cuts on trial made better
    History history;
    // What follows from the above; kept for readers of the file.
    std::vector<Cut> cuts;  // those in force
    std::vector<SolidRecord> pieces;
    std::vector<SolidRecord> fragment_list;
    std::vector<Discard> discards;       // those in force
    std::vector<SolidRecord> discarded;  // the discarded pieces, one per discard
    std::vector<std::string> warnings;
    std::optional<BeamState> beam;      // of a search that was interrupted and can go on
    std::optional<SetupReview> review;  // what setups said of the cuts after the search; nothing: they were not asked
    bool has_programs = true;           // whether jobs are written with robot programs, where the cell allows it
    std::vector<std::uint16_t> tools;   // numbers of those that may be used; empty: all of the cell
    bool has_all_fine_tools = false;    // small tools finish also what adds little (FineTools::all)
    std::vector<WrittenJob> jobs;       // in the order of the pieces and their parts; none of a piece that does not fit
    bool operator==(const Project&) const = default;

    bool do_rules_hold() const { return !end_reason || is_finished(*end_reason); }
};

}  // namespace qchopper
