#include "tests/sim/replay/mutations.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "sim/replay/replay.h"
#include "tests/sim/replay/box_job.h"

namespace qchopper {
namespace {

// What the manifest says after names, sizes and hashes were made again: the chunks that are called, in their order.
ReplayScene remade(const ReplayScene& scene, const ProgramFiles& files) {
    ReplayScene changed = scene;
    changed.chunks.clear();
    for (const std::string& name : called_chunks(files, "qc_1")) {
        for (const SceneChunk& chunk : scene.chunks) {
            if (chunk.name == name) changed.chunks.push_back(chunk);
        }
    }
    return changed;
}

// Why a program is refused; empty if it is not.
std::string refusal(const BoxJob& job, const ProgramFiles& files) {
    ReplayOptions options;
    options.cell = 0.5;
    options.volume_cell = 1;
    options.leftover.reach_cell = 1;
    options.leftover.sample_mm = 4;
    try {
        const ReplayReport report = replay(read_back(job, files), remade(job.scene(), files), options);
        if (report.is_good) return "";
        std::string kinds;
        for (std::size_t i = 0; i < finding_kinds; ++i) {
            if (report.counts[i] > 0)
                kinds += std::string(kinds.empty() ? "" : " ") + to_word(static_cast<FindingKind>(i));
        }
        return kinds;
    } catch (const InputError& error) {
        return std::string("not read: ") + error.what();
    }
}

// Mutants of this job that mill the same piece and break no rule: the tool points straight down, where signs and order
// of A and C only turn it about its axis; a point is moved along its line; above a chunk's last point nothing stands;
// no cut is so deep that its feed is lowered, and corners are rounded beside the piece.
const std::vector<std::string> equivalent{"angle_sign_lost",   "angles_in_wrong_order",  "point_moved_x",
                                          "last_retract_lost", "full_feed_in_full_cuts", "rounded_2_mm_farther"};

TEST(Mutations, EachIsRefused) {
    std::size_t refused = 0;
    for (const char* cell : {"kr60-ha", "kr120-r2500-pro-rotary"}) {
        const BoxJob job = box_job(cell);
        EXPECT_EQ(refusal(job, job.files()), "");
        for (const Mutation& mutation : all_mutations()) {
            const auto mutant = mutation.apply(job.files());
            if (!mutant) continue;
            const std::string why = refusal(job, *mutant);
            if (std::find(equivalent.begin(), equivalent.end(), mutation.name) != equivalent.end()) continue;
            ++refused;
            EXPECT_NE(why, "") << mutation.name;
        }
    }
    EXPECT_GE(refused, 80U);
}

}  // namespace
}  // namespace qchopper
