// The project folder NAME.qch: the operator's decisions, saved when they are made.
//
//   NAME.qch/
//     project.json      scan, settings, decisions with their terms and runners-up, pieces, crumbs
//     cell.toml         the cell file as it was when it was named; none: the project knows no cell yet
//     pieces/A.ply ...  the pieces (binary PLY, double, face property cap = number of the cut)
//     jobs/A.qjob ...   one job file per piece
//     pictures/*.png
//     cache/            prices that are known already; may be deleted at any time
//     lock              held while a program writes
//
// project.json alone decides: scan and decisions give the same pieces again, bit for bit
// (tests/app/project/project_test.cpp). Pieces, jobs and pictures are never stale: they are taken away before a
// decision changes and written when the cutting is over (products.h). docs/project-folder.md is the grammar.

#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/project/decisions.h"
#include "segment/import/import_scan.h"
#include "segment/repair/choices.h"
#include "segment/search/search.h"

namespace qchopper {

enum class CrumbChoice { keep, drop };  // keep: written to pieces/crumbs.ply; drop: only listed

// Which scan, and how its numbers became millimetres.
struct ScanSource {
    std::filesystem::path path;  // absolute
    std::string sha256;
    Unit unit = Unit::mm;
    double scale = 1;
    Vec3 centre;  // mm, subtracted from all points
    std::size_t faces = 0;
    double volume_mm3 = 0;
    std::vector<std::string> warnings = {};  // what intake said
    RepairChoices repair = {};               // how it was made a solid
    bool operator==(const ScanSource&) const = default;
};

// What the project says about a leaf or a crumb. Derived from scan and cuts; kept for whoever reads the file.
struct SolidRecord {
    std::string name;      // empty for a crumb
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
    CrumbChoice crumbs = CrumbChoice::keep;
    Stage stage = Stage::cutting;
    std::string ended_because;
    History history;
    // What follows from the above; kept for whoever reads the file.
    std::vector<Cut> cuts;  // those that stand
    std::vector<SolidRecord> pieces;
    std::vector<SolidRecord> crumb_list;
    std::vector<Discard> discards;       // those that stand
    std::vector<SolidRecord> discarded;  // what they took out, in their order
    std::vector<std::string> warnings;
    std::optional<BeamState> beam;  // of a search that was interrupted and can go on
    std::vector<WrittenJob> jobs;   // in the order of the pieces; a piece that does not fit has none
    bool operator==(const Project&) const = default;
};

// Copies what the segmentation says now into the project: cuts, then discarded pieces, that the history does not have
// yet are decided, cuts at its end that the segmentation has no more are given up (decisions.h, follow).
void record(Project& project, const Segmentation& segmentation);

// Written aside and renamed: a crash leaves the decisions before or after, never half of them.
void save_project(const std::filesystem::path& folder, const Project& project);

// Throws InputError: (missing) no project there, (config) a project file that this version cannot read.
Project load_project(const std::filesystem::path& folder);

// Applies the cuts that stand to the scan exactly as they were made, and takes out what is discarded. Throws InputError
// (config) if a cut misses or a piece is not there.
Segmentation replay(const Project& project, const TriangleMesh& scan);
// The same with the first `cuts` of them only, and what was discarded before the next.
Segmentation replay(const Project& project, const TriangleMesh& scan, std::size_t cuts);

// Where the search of a project goes on: at its beam if it has one. `standing` is what its cuts make.
BeamProgress beam_progress(const Project& project, const Segmentation& standing,
                           const std::function<const TriangleMesh&()>& scan);

// Keeps a second writer out while it lives. Throws InputError (busy) if somebody else holds it.
class ProjectLock {
 public:
    explicit ProjectLock(const std::filesystem::path& folder);
    ~ProjectLock();
    ProjectLock(const ProjectLock&) = delete;
    ProjectLock& operator=(const ProjectLock&) = delete;

 private:
    int descriptor_;
};

}  // namespace qchopper
