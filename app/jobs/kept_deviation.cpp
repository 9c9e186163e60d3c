// One file per job.

#include "app/jobs/kept_deviation.h"

#include <algorithm>

#include "app/store/caches/cache_file.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// To be raised whenever the proof finds other deviations of the same job.
constexpr std::uint32_t version_of_deviations = 1;

fs::path file_for(const fs::path& folder, const Sha256& job, const Sha256& cell) {
    CacheWriter key;
    key.put(version_of_deviations);
    for (const Sha256& hash : {job, cell}) {
        for (const std::uint8_t byte : hash.bytes) key.put(byte);
    }
    return cache_file(folder, key, deviations_ending);
}

}  // namespace

void keep_deviation(const fs::path& folder, const Sha256& job, const Sha256& cell, const JobProof& proof) {
    if (proof.deviation.empty()) return;
    CacheWriter content;
    content.put_all(proof.deviation);
    content.put_all(std::vector<std::uint8_t>(proof.is_given_up.begin(), proof.is_given_up.end()));
    keep(file_for(folder, job, cell), content);
}

std::optional<JobDeviation> kept_deviation(const fs::path& folder, const Sha256& job, const Sha256& cell) {
    const std::optional<Bytes> bytes = kept(file_for(folder, job, cell));
    if (!bytes) return std::nullopt;
    CacheReader in(*bytes);
    JobDeviation deviation;
    deviation.mm = in.get_all<float>();
    for (const std::uint8_t given_up : in.get_all<std::uint8_t>()) deviation.is_given_up.push_back(given_up != 0);
    const bool is_of_same = deviation.is_given_up.empty() || deviation.is_given_up.size() == deviation.mm.size();
    if (!in.is_whole() || deviation.mm.empty() || !is_of_same) return std::nullopt;
    return deviation;
}

}  // namespace qchopper
