// Keeps how far from its piece the proof found each triangle, so that it can be shown without proving again. The files
// may be deleted at any time.
//
// A file is named by the SHA-256 of the job file and of the cell file, and ends in a SHA-256 of its content
// (tests/app/jobs/kept_deviation_test.cpp). O(triangles).

#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "app/jobs/job_proof.h"
#include "base/sha256.h"

namespace qchopper {

constexpr const char* deviations_ending = ".deviation";  // of the names of the files

struct JobDeviation {
    std::vector<float> mm;          // as JobProof::deviation
    std::vector<bool> is_given_up;  // per triangle, or none
    bool operator==(const JobDeviation&) const = default;
};

// What the proof of a job found; nothing of one that could not be replayed.
void keep_deviation(const std::filesystem::path& folder, const Sha256& job, const Sha256& cell, const JobProof& proof);

// Nothing if it is not kept, or damaged.
std::optional<JobDeviation> kept_deviation(const std::filesystem::path& folder, const Sha256& job, const Sha256& cell);

}  // namespace qchopper
