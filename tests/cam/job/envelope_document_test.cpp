// envelope.json: what is written is what was judged, and a forged verdict is refused.

#include "cam/job/envelope_document.h"

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/zip.h"
#include "cam/job/read_job.h"
#include "cam/job/write_job.h"
#include "tests/cam/job/some_job.h"

namespace qchopper {
namespace {

using namespace test_pieces;
using nlohmann::ordered_json;

std::string refusal(const std::string& text) {
    try {
        read_envelope_document(text, "AB.qjob");
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::mesh);
        return error.what();
    }
    return "taken";
}

std::string forged(const std::function<void(ordered_json&)>& change) {
    ordered_json json = ordered_json::parse(envelope_document(placed_job()));
    change(json);
    return json.dump(2) + "\n";
}

TEST(EnvelopeDocument, ListsEveryCheckWithItsMarginAndPose) {
    const JobInput input = placed_job();
    const auto json = nlohmann::json::parse(envelope_document(input));
    ASSERT_EQ(json["checks"].size(), input.machine_reachability.margins.size());
    for (std::size_t i = 0; i < json["checks"].size(); ++i) {
        const auto& check = json["checks"][i];
        const ReachabilityMargin& margin = input.machine_reachability.margins[i];
        EXPECT_EQ(check["check"], rule_of(margin.check).key);
        EXPECT_NEAR(check["margin"].get<double>(), margin.margin, 1e-6);
        EXPECT_NEAR(check["measured"].get<double>() - check["needed"].get<double>(), margin.margin, 2e-6);
        EXPECT_EQ(check["between"], margin.pair);
        EXPECT_EQ(check["pose"].is_null(), margin.check == PoseCheck::block_on_table);
    }
    EXPECT_EQ(json["tightest"], rule_of(input.machine_reachability.tightest().check).key);
    EXPECT_EQ(json["arm_checked"], true);
    EXPECT_EQ(json["holds"], true);
    EXPECT_GT(json["regions"].size(), 0U);
}

TEST(EnvelopeDocument, IsInTheJobAndVerified) {
    const JobInput input = placed_job();
    const Bytes bytes = job_file(input);
    const ReadJob job = parse_job(bytes, "AB.qjob");
    EXPECT_TRUE(job.is_arm_checked);
    EXPECT_TRUE(job.holds_poses);
    EXPECT_EQ(job.setup, input.setup) << "the placement too";
    ASSERT_EQ(job.setup_in_cell.size(), 1U);
    EXPECT_EQ(job.setup_in_cell[0], setup_in_cell(input.cell, input.setup.spoil, input.setup.placement, 0));
    EXPECT_EQ(text_of(job.files.at("envelope.json")), envelope_document(input));
    EXPECT_TRUE(job.files.contains("envelope.png"));
    std::map<std::string, Bytes> files = unzip(bytes, "AB.qjob");
    files["envelope.json"][40] ^= 1;
    try {
        parse_job(zip(files), "AB.qjob");
        FAIL() << "taken";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("envelope.json does not match its SHA-256"), std::string::npos);
    }
}

TEST(EnvelopeDocument, RefusesAVerdictThatItsMarginsContradict) {
    EXPECT_EQ(refusal(forged([](ordered_json&) {})), "taken");
    EXPECT_NE(refusal(forged([](ordered_json& j) { j["checks"][1]["margin"] = -5.0; })).find("contradicts the margin"),
              std::string::npos);
    EXPECT_NE(refusal(forged([](ordered_json& j) {
                  j["checks"][1]["margin"] = -5.0;
                  j["checks"][1]["holds"] = false;
              })).find("contradicts the checks"),
              std::string::npos);
    EXPECT_NE(refusal(forged([](ordered_json& j) { j["checks"] = ordered_json::array(); })).find("arm_checked"),
              std::string::npos);
    EXPECT_NE(refusal(forged([](ordered_json& j) { j["schema"] = 3; })).find("schema"), std::string::npos);
    EXPECT_NE(refusal(forged([](ordered_json& j) { j.erase("placement"); })).find("placement"), std::string::npos);
}

TEST(EnvelopeDocument, SaysThatTheArmWasNotChecked) {
    const JobInput input = some_job(3);
    const auto json = nlohmann::json::parse(envelope_document(input));
    EXPECT_EQ(json["arm_checked"], false);
    EXPECT_EQ(json["summary"], "piece AB: arm not checked");
    const ReadJob job = parse_job(job_file(input), "AB.qjob");
    EXPECT_FALSE(job.is_arm_checked);
    EXPECT_TRUE(job.holds_poses);
    EXPECT_FALSE(job.files.contains("envelope.png"));
}

}  // namespace
}  // namespace qchopper
