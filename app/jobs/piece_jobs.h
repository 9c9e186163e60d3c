// Writes the jobs of a segmentation into the project folder, each with its verdict beside it.
//
// They are never stale: they are removed before a decision changes and written when the cutting is over (outputs.h).
// All throw what write_file throws.

#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/jobs/access_advice.h"
#include "app/jobs/job_verdict.h"
#include "app/jobs/setups.h"
#include "app/jobs/work_item.h"
#include "app/store/project.h"
#include "base/context.h"
#include "segment/joint/piece_joints.h"

namespace qchopper {

// The share of a piece's surface that may stay out of reach: the operator's, or else the cell's. A cell without a
// machine sets no limit: 1.
double max_unreachable(const Project& project, const Cell& cell);

// The result of prepare for one piece.
struct PieceReport {
    std::string name;
    std::size_t faces = 0;
    double volume_mm3 = 0;
    PlacedSetup piece_setup;
    std::filesystem::path job;              // empty: it has no job, because it does not fit the cell or is only sawn
    std::vector<AccessAdvice> advice = {};  // of a piece of which more is out of reach than may be
    std::string no_program_because = {};    // empty: its jobs hold robot programs
    bool is_machine_refusing = false;       // it has none because the arm does not follow its toolpath
    std::vector<JobVerdict> verdicts = {};  // one per part of its program
    double time_s = 0;                      // of all its parts, as the replay finds it
    double length_mm = 0;
    bool has_kept_programs = false;  // an earlier run made and proved them (kept_programs.h)
    bool is_only_sawn = false;       // the saw alone makes it (cam/job/glue_faces.h)
    bool fits() const { return is_only_sawn || piece_setup.fits(); }
    bool is_proven() const;  // every part is; false without a program
};

// What programs and job of one piece are made from, also where prepare was asked for no programs. write_jobs() takes
// the file WorkItem::result from the project's cache. `index` and `joints` as in write_job().
WorkItem item_of(const std::filesystem::path& folder, const Project& project, const Segmentation& segmentation,
                 std::size_t index, Setups& setups, std::span<const PieceJoint> joints,
                 const std::string& program_version);

// What is told of a piece before its job is written.
PieceReport report_without_job(const std::filesystem::path& folder, const Project& project, const Piece& piece,
                               Setups& setups);

enum class MissingToolpaths { made, not_made };

// One report per piece, in which no_program_because and is_machine_refusing say what will become of its program as far
// as the arm was asked, by programs and toolpaths in the project's cache; none in a project whose jobs get no programs.
// Toolpaths that are missing are made and kept there (kept_toolpaths.h), where write_jobs() takes them; or, if they are
// not to be made, there is no report of any piece. Throws Cancelled; what is made stays.
std::vector<PieceReport> follow_toolpaths(const std::filesystem::path& folder, const Project& project,
                                          const Segmentation& segmentation, Setups& setups,
                                          std::span<const PieceJoint> joints, const std::string& program_version,
                                          MissingToolpaths missing, const Context& context);

// Writes jobs/<name>.qjob of one piece, and those of further parts, if it fits the cell and the saw alone does not make
// it, else removes them, and records them in the project, which is not saved. `index` is that of the piece in the
// segmentation, `joints` are those of all its pieces.
PieceReport write_job(const std::filesystem::path& folder, Project& project, const Segmentation& segmentation,
                      std::size_t index, Setups& setups, std::span<const PieceJoint> joints,
                      const std::string& program_version, const Context& context);

// The same for all pieces; no other job stays recorded. Each is recorded and the project saved as soon as it is
// written, so that it can be rehearsed while others are made; then `on_job` is called, unless it is empty, from one
// thread at a time. One report per piece. Throws Cancelled.
std::vector<PieceReport> write_jobs(const std::filesystem::path& folder, Project& project,
                                    const Segmentation& segmentation, Setups& setups,
                                    std::span<const PieceJoint> joints, const std::string& program_version,
                                    const std::function<void(const PieceReport&)>& on_job, const Context& context);

}  // namespace qchopper
