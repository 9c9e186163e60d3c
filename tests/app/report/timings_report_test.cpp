#include "app/report/timings_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace qchopper {
namespace {

RunTimes some_times() {
    return {{{"scan read", {1, 1.5}}, {"planes ranked", {2, 3.5}}}, {4, 6}, 5'000'000};
}

TEST(TimingsReport, TheDocumentHasOneKeyMoreAndKeepsItsFormAndEveryNumber) {
    const nlohmann::ordered_json plain{{"schema", "s-1"}, {"third", 1.0 / 3}, {"count", 18446744073709551615U}};
    for (const Document& document : {compose(plain), compose_line(plain)}) {
        const Document timed = with_timings(document, some_times());
        const std::string text = text_of(timed);
        EXPECT_EQ(text.find('\n') == std::string::npos, document.is_one_line) << text;
        nlohmann::ordered_json read = nlohmann::ordered_json::parse(text);
        EXPECT_EQ(std::prev(read.end()).key(), "timings");
        EXPECT_EQ(read["timings"]["stages"][1]["name"], "planes ranked");
        EXPECT_EQ(read["timings"]["stages"][1]["cpu_s"], 3.5);
        EXPECT_EQ(read["timings"]["wall_s"], 4);
        EXPECT_EQ(read["timings"]["peak_memory_bytes"], 5'000'000);
        read.erase("timings");
        EXPECT_EQ(read, plain);
        EXPECT_EQ(*document.json, plain) << "the other document is as it was";
    }
}

TEST(TimingsReport, BytesOfOthersThatAreNoTextAreReplaced) {
    for (const Document& document : {compose({{"name", "a\xff"}}), compose_line({{"name", "a\xff"}})}) {
        EXPECT_EQ(nlohmann::json::parse(text_of(document))["name"], "a\xEF\xBF\xBD");
    }
}

TEST(TimingsReport, WhatIsInNoStageHasARowOfItsOwn) {
    const std::vector<std::string> rows = table(some_times());
    ASSERT_EQ(rows.size(), 6U);
    EXPECT_NE(rows[1].find("25.0 %"), std::string::npos) << rows[1];
    EXPECT_TRUE(rows[3].starts_with("in no stage")) << rows[3];
    EXPECT_NE(rows[3].find("1.000"), std::string::npos) << rows[3];
    EXPECT_NE(rows[5].find("5 MB"), std::string::npos) << rows[5];
}

}  // namespace
}  // namespace qchopper
