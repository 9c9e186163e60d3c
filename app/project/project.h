// A project: a scan, settings, the operator's decisions, and what follows from them.
//
// Values only. project_folder.h keeps a project on disk, open_project.h makes it advance.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/project/decisions.h"
#include "segment/import/import_scan.h"
#include "segment/repair/choices.h"
#include "segment/search/search.h"

namespace qchopper {

enum class FragmentChoice { keep, drop };  // keep: written to pieces/fragments.ply; drop: only listed

// Which scan, and how its numbers became millimetres.
struct ScanSource {
    std::filesystem::path path;  // absolute
    std::string sha256;
    Unit unit = Unit::mm;
    double scale = 1;
    Vec3 centre;  // mm, subtracted from all points
    std::size_t faces = 0;
    double volume_mm3 = 0;
    std::vector<std::string> warnings = {};  // what import said
    RepairChoices repair = {};               // how it was made a solid
    bool operator==(const ScanSource&) const = default;
};

// What the project says about a leaf or a fragment. Derived from scan and cuts; kept for whoever reads the file.
struct SolidRecord {
    std::string name;      // empty for a fragment
    std::int32_t cut = 0;  // the cut that made it; 0: it was in the scan
    std::size_t faces = 0;
    double volume_mm3 = 0;
    Vec3 centre;
    bool operator==(const SolidRecord&) const = default;
};

// A job file as it was written: what dispatch holds the file in the folder against.
struct WrittenJob {
    std::string piece;
    std::string sha256;      // of the whole file
    std::string project_id;  // 32 hexadecimal digits, as in the job itself
    bool operator==(const WrittenJob&) const = default;
};

enum class Stage {
    cutting,  // the search goes on
    cut,      // all cuts are made, jobs are not yet all written
    done
};

struct Project {
    ScanSource scan;
    std::string preset;       // empty: none
    SearchSettings settings;  // their weights are those that stand now
    FragmentChoice fragments = FragmentChoice::keep;
    Stage stage = Stage::cutting;
    std::optional<EndReason> end_reason;  // of the search; nothing: it has not ended
    std::string ended_because;            // the same as a sentence with its figure
    History history;
    // What follows from the above; kept for whoever reads the file.
    std::vector<Cut> cuts;  // those that stand
    std::vector<SolidRecord> pieces;
    std::vector<SolidRecord> fragment_list;
    std::vector<Discard> discards;       // those that stand
    std::vector<SolidRecord> discarded;  // what they took out, in their order
    std::vector<std::string> warnings;
    std::optional<BeamState> beam;  // of a search that was interrupted and can go on
    std::vector<WrittenJob> jobs;   // in the order of the pieces; a piece that does not fit has none
    bool operator==(const Project&) const = default;

    bool do_rules_hold() const { return !end_reason || is_finished(*end_reason); }
};

}  // namespace qchopper
