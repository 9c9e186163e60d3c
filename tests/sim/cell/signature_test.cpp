// A cell that checks signatures: every way in which one is refused, and when.

#include <gtest/gtest.h>

#include "devices/wire/ticket_signature.h"
#include "sim/cell/signature_check.h"
#include "tests/sim/cell/cell_bench.h"

namespace qchopper {
namespace {

using bench::Bench;
using bench::good_ticket;
using bench::job_a;

struct SignatureTest : testing::Test {
    SignatureTest() {
        bench.cell.limits.require_signature = true;
        bench.hooks.trusted_keys = [this] { return keys; };
    }
    // Writes a ticket that is signed by `signer`, then STORE.
    AckResult store(const Ed25519PrivateKey& signer) {
        bench.write_ticket(ticket_of(signer));
        bench.cell.signature_draft = sign_ticket(signer, bench.cell.ticket_draft);
        return bench.send(CellCommand::store, job_a);
    }
    static WireTicket ticket_of(const Ed25519PrivateKey& signer) {
        WireTicket ticket = good_ticket();
        ticket.key_id = key_id_of(signer.public_key());
        return ticket;
    }
    // With the job stored, verified and prepared.
    void to_prepared() {
        bench.to_idle();
        ASSERT_EQ(store(key), AckResult::ok);
        ASSERT_EQ(bench.send(CellCommand::verify, job_a), AckResult::pending);
        file_checked(bench.cell, bench.cell.pending->number,
                     {FileCheck::End::ok, good_ticket().file_size, good_ticket().file_sha256}, bench.now, bench.hooks);
        ASSERT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::pending);
        bench.pass(10);
        ASSERT_EQ(bench.cell.ack.result, AckResult::ok);
    }
    std::uint32_t detail() const { return bench.cell.ack.detail; }

    const Ed25519PrivateKey key = Ed25519PrivateKey::make();
    std::vector<CellKey> keys{{key.public_key(), false}};
    Bench bench;
};

TEST_F(SignatureTest, AJobSignedByATrustedKeyRuns) {
    to_prepared();
    EXPECT_EQ(bench.send(CellCommand::start, job_a, bench.cell.job.token), AckResult::ok);
    EXPECT_EQ(bench.cell.memory.starts_total, 1U);
}

TEST_F(SignatureTest, AnUnsignedTicketIsRefusedUnderTheStrictPolicyOnly) {
    bench.to_idle();
    bench.write_ticket(good_ticket());
    EXPECT_EQ(bench.send(CellCommand::store, job_a), AckResult::bad_signature);
    EXPECT_EQ(detail(), signature_detail::unsigned_ticket);
    EXPECT_EQ(bench.cell.job.state, JobState::none);
    bench.cell.limits.require_signature = false;
    EXPECT_EQ(bench.send(CellCommand::store, job_a), AckResult::ok);
}

TEST_F(SignatureTest, ASignatureThatWasTakenAwayIsMissedUnderAnyPolicy) {
    bench.cell.limits.require_signature = false;
    bench.to_idle();
    bench.write_ticket(ticket_of(key));
    EXPECT_EQ(bench.send(CellCommand::store, job_a), AckResult::bad_signature);
    EXPECT_EQ(detail(), signature_detail::unsigned_ticket);
}

TEST_F(SignatureTest, AnUntrustedOrRevokedKeyIsRefused) {
    bench.to_idle();
    EXPECT_EQ(store(Ed25519PrivateKey::make()), AckResult::unknown_key);
    EXPECT_EQ(detail(), 0U);
    keys[0].is_revoked = true;
    EXPECT_EQ(store(key), AckResult::unknown_key);
    EXPECT_EQ(detail(), signature_detail::revoked_key);
    EXPECT_EQ(bench.cell.job.state, JobState::none);
}

TEST_F(SignatureTest, ATicketThatWasChangedAfterSigningIsRefused) {
    bench.to_idle();
    bench.write_ticket(ticket_of(key));
    const Registers signature = sign_ticket(key, bench.cell.ticket_draft);
    const auto changed = [&](auto change) {
        WireTicket ticket = ticket_of(key);
        change(ticket);
        bench.write_ticket(ticket);
        bench.cell.signature_draft = signature;
        return bench.send(CellCommand::store, ticket.job_id);
    };
    EXPECT_EQ(changed([](WireTicket& t) { t.feed_max_mm_per_min += 1; }), AckResult::bad_signature);
    EXPECT_EQ(changed([](WireTicket& t) { t.cell_id = 9; }), AckResult::bad_signature);
    EXPECT_EQ(changed([](WireTicket& t) { t.made_for = 0; }), AckResult::bad_signature);
    EXPECT_EQ(changed([](WireTicket& t) { t.job_id[15] = 1; }), AckResult::bad_signature);
    EXPECT_EQ(detail(), 0U);
    EXPECT_EQ(changed([](WireTicket&) {}), AckResult::ok);
}

TEST_F(SignatureTest, ATicketSignedForAnotherCellOrForARealOneIsRefused) {
    bench.cell.limits.cell_id = 7;
    bench.to_idle();
    const auto signed_with = [&](std::uint16_t cell, std::uint16_t made_for) {
        WireTicket ticket = ticket_of(key);
        ticket.cell_id = cell;
        ticket.made_for = made_for;
        bench.write_ticket(ticket);
        bench.cell.signature_draft = sign_ticket(key, bench.cell.ticket_draft);
        return bench.send(CellCommand::store, job_a);
    };
    EXPECT_EQ(signed_with(8, 1), AckResult::ticket_field);
    EXPECT_EQ(detail(), address_of(ticket_block, "CELL_ID"));
    EXPECT_EQ(signed_with(7, 0), AckResult::ticket_field);
    EXPECT_EQ(detail(), address_of(ticket_block, "MADE_FOR"));
    EXPECT_EQ(signed_with(7, 1), AckResult::ok);
}

TEST_F(SignatureTest, AKeyThatIsRevokedBeforePrepareIsRefusedThere) {
    bench.to_idle();
    ASSERT_EQ(store(key), AckResult::ok);
    ASSERT_EQ(bench.send(CellCommand::verify, job_a), AckResult::pending);
    file_checked(bench.cell, bench.cell.pending->number,
                 {FileCheck::End::ok, good_ticket().file_size, good_ticket().file_sha256}, bench.now, bench.hooks);
    keys[0].is_revoked = true;
    EXPECT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::unknown_key);
    EXPECT_EQ(detail(), signature_detail::revoked_key);
    EXPECT_FALSE(bench.cell.pending);
}

TEST_F(SignatureTest, AKeyThatIsRevokedBetweenConsentAndStartIsRefusedAtStart) {
    to_prepared();
    keys[0].is_revoked = true;
    EXPECT_EQ(bench.send(CellCommand::start, job_a, bench.cell.job.token), AckResult::unknown_key);
    EXPECT_EQ(detail(), signature_detail::revoked_key);
    EXPECT_EQ(bench.cell.memory.starts_total, 0U);
    EXPECT_EQ(bench.cell.job.state, JobState::prepared);
    keys.clear();
    EXPECT_EQ(bench.send(CellCommand::start, job_a, bench.cell.job.token), AckResult::unknown_key);
    EXPECT_EQ(bench.cell.memory.starts_total, 0U);
}

TEST_F(SignatureTest, AWrongTokenIsSaidBeforeTheSignature) {
    to_prepared();
    keys.clear();
    EXPECT_EQ(bench.send(CellCommand::start, job_a, bench.cell.job.token + 1), AckResult::token_bad);
}

TEST_F(SignatureTest, OfAStrangersSignatureUnderATrustedIdIsSaidThatItIsWrong) {
    const Registers ticket = encode(ticket_of(key));
    const auto fault = wrong_signature(ticket, sign_ticket(Ed25519PrivateKey::make(), ticket), {}, bench.hooks);
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->result, AckResult::bad_signature);
    EXPECT_EQ(fault->detail, 0U);
    EXPECT_FALSE(wrong_signature(ticket, sign_ticket(key, ticket), {}, bench.hooks));
}

TEST_F(SignatureTest, ACellWithoutAListTakesNoSignatureIfItRequiresOne) {
    bench.hooks.trusted_keys = nullptr;
    bench.to_idle();
    EXPECT_EQ(store(key), AckResult::unknown_key);
    bench.cell.limits.require_signature = false;
    EXPECT_EQ(store(key), AckResult::ok);
}

}  // namespace
}  // namespace qchopper
