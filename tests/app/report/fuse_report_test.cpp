#include "app/report/scan/fuse_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace qchopper {
namespace {

Fused fused() {
    Fused fused;
    fused.mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}};
    FuseReport& report = fused.report;
    report.scans = {{"a.ply", 1200, 2300, 90, 0.00012, true, {}}, {"b c.ply", 10, 12, 40, 0.5, false, {}}};
    report.scans[1].pose.shift = {4, 5, 6};
    report.is_other_sign = true;
    report.voxel = 0.0005;
    report.rounds = 7;
    report.open_edges = 3;
    report.shells_left_out = 1;
    return fused;
}

TEST(FuseReport, NamesTheScanThatDoesNotFitAndTheNextStep) {
    const std::vector<std::string> text = lines(fused(), "out dir/m.ply");
    ASSERT_EQ(text.size(), 7U);
    EXPECT_EQ(text[1].find("does not fit"), std::string::npos);
    EXPECT_NE(text[2].find("b c.ply"), std::string::npos);
    EXPECT_NE(text[2].find("does not fit"), std::string::npos);
    EXPECT_NE(text[3].find("7 rounds"), std::string::npos);
    EXPECT_NE(text[4].find("opposite sign"), std::string::npos);
    EXPECT_NE(text[5].find("1 faces, voxel 0.0005, 3 open edges, 1 small shell left out"), std::string::npos)
        << text[5];
    EXPECT_EQ(text[6], "Next: qchopper repair 'out dir/m.ply' -o 'out dir/m-solid.ply'");
}

TEST(FuseReport, WhatRepairCannotCloseIsSaid) {
    Fused open = fused();
    open.report.missing_share = 0.404;
    const std::vector<std::string> text = lines(open, "m.ply");
    EXPECT_NE(text.at(6).find("closing the mesh takes at least 40 % of its area"), std::string::npos) << text[6];
    EXPECT_EQ(text.back(), "Next: qchopper inspect m.ply");
}

TEST(FuseReport, TheDocumentHasTheKeysOfThePage) {
    const nlohmann::ordered_json json = *document(fused(), "m.ply").json;
    EXPECT_EQ(json.at("schema"), "qchopper-fuse-1");
    EXPECT_EQ(json.at("faces"), 1);
    EXPECT_EQ(json.at("scans").at(1).at("fits"), false);
    EXPECT_EQ(json.at("scans").at(1).at("pose").at(2), (nlohmann::ordered_json{0.0, 0.0, 1.0, 6.0}));
    EXPECT_EQ(json.at("opposite_sign_of_qr"), true);
}

}  // namespace
}  // namespace qchopper
