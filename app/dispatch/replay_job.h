// Replays the job of a project to be looked at, with the deviation that its proof found.
//
// mm, seconds, setup coordinates (tests/app/cli/replay_test.cpp).

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/jobs/kept_deviation.h"
#include "base/box.h"
#include "base/context.h"
#include "base/sha256.h"
#include "segment/mesh/triangle_mesh.h"
#include "sim/replay/stages/replay_stages.h"

namespace qchopper {

struct ReplayOrder {
    std::filesystem::path project;
    std::string piece;
    std::uint16_t part = 1;
};

// What is replayed.
struct ReplayedJob {
    std::string piece;
    std::uint16_t part = 1;
    std::uint16_t parts = 1;
    Sha256 job;
    Sha256 cell;                     // of the cell file
    bool is_positive = false;        // its verdict
    double proven_time_s = 0;        // by it; 0: its proof could not replay it
    Box block;                       // as it stands before the program
    TriangleMesh mesh;               // of the piece
    std::vector<std::string> files;  // of the program: the names of WayPoint::place
    std::vector<Vec3> tool_axes;     // per orientation: unit vectors from the tip into the spindle
    std::vector<std::pair<std::uint16_t, std::string>> tools;  // number and name, of the cell
};

class JobToReplay {
 public:
    // Throws what jobs_of throws (dispatch_jobs.h), where a job is gone or not the one that was ordered; InputError
    // (use): no such part, no robot program, or no verdict on these bytes of job and cell file; (mesh) for a program
    // that cannot be read.
    JobToReplay(const ReplayOrder& order, const Context& context);
    ~JobToReplay();
    JobToReplay(const JobToReplay&) = delete;
    JobToReplay& operator=(const JobToReplay&) = delete;

    const ReplayedJob& about() const;
    // Throws what replay_in_stages() throws.
    StagedReplay replay(const StageOptions& options, const StageTaker& take, const Context& context) const;
    // What was kept of the proof, or is proven again and kept then. Nothing before the last part, when the piece is not
    // there yet, and where the program cannot be replayed. Throws Cancelled.
    std::optional<JobDeviation> deviation(const Context& context) const;

 private:
    struct Content;
    std::unique_ptr<const Content> content_;
};

}  // namespace qchopper
