// Signed hand-offs over TCP: the words with which a job is refused, and that nothing is started then.

#include <gtest/gtest.h>

#include <atomic>

#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

// A cell that requires the signature of `key`, and a dispatcher of one job.
struct SignedRig {
    SignedRig() {
        CellSimOptions options = rig::quick_cell(folder.path);
        options.limits.require_signature = true;
        options.trusted_keys = [this] { return std::vector<CellKey>{{key.public_key(), is_revoked}}; };
        cell = std::make_unique<CellSim>(options);
        cell->start();
    }
    JobOutcome dispatch(const DispatchOptions& options) const {
        const auto bus = rig::connect(*cell);
        return dispatch_job(*bus, job.ticket, job.file, options, {});
    }
    DispatchOptions signed_by(const std::optional<Ed25519PrivateKey>& signer) const {
        DispatchOptions options = rig::quick_dispatch(folder.path);
        options.signing_key = signer;
        return options;
    }
    // Of a dispatch that the cell refuses.
    std::string refusal(const DispatchOptions& options) const {
        const JobOutcome outcome = dispatch(options);
        EXPECT_EQ(outcome.start_outcome, StartOutcome::not_started) << outcome.why;
        EXPECT_EQ(cell->status().starts_total, 0U);
        EXPECT_FALSE(outcome.to_do.empty());
        return outcome.why;
    }

    rig::Folder folder;
    const Ed25519PrivateKey key = Ed25519PrivateKey::make();
    std::atomic<bool> is_revoked = false;
    const rig::Job job = rig::make_job();
    std::unique_ptr<CellSim> cell;
};

bool says(const std::string& text, const char* words) {
    return text.find(words) != std::string::npos;
}

TEST(Fault, F40_AJobWithoutARightSignatureIsRefusedInWordsThatSayWhich) {
    SignedRig rig;
    EXPECT_TRUE(says(rig.refusal(rig.signed_by(std::nullopt)), "the ticket is not signed (BAD_SIGNATURE)"));
    EXPECT_TRUE(says(rig.refusal(rig.signed_by(Ed25519PrivateKey::make())), "UNKNOWN_KEY"));
    rig.is_revoked = true;
    EXPECT_TRUE(says(rig.refusal(rig.signed_by(rig.key)), "the key of the signature is revoked (UNKNOWN_KEY)"));
    rig.is_revoked = false;
    const JobOutcome right = rig.dispatch(rig.signed_by(rig.key));
    EXPECT_EQ(right.start_outcome, StartOutcome::started) << right.why;
    EXPECT_EQ(rig.cell->status().starts_total, 1U);
}

TEST(SignedHandOff, AKeyThatIsRevokedBetweenStoreAndStartStartsNothing) {
    SignedRig rig;
    DispatchOptions options = rig.signed_by(rig.key);
    bool was_prepared = false;
    options.at_point = [&](const std::string& point) {
        if (point != "after_start_intent") return;
        was_prepared = rig.cell->status().job_state == JobState::prepared;
        rig.is_revoked = true;
    };
    options.journal = [](const JournalEvent&) {};
    const std::string why = rig.refusal(options);
    EXPECT_TRUE(was_prepared);
    EXPECT_TRUE(says(why, "at Start: the key of the signature is revoked")) << why;
}

}  // namespace
}  // namespace qchopper
