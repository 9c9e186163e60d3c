#include "cam/job/sheet/order_sheets.h"

#include <gtest/gtest.h>

#include "base/base64.h"
#include "cam/job/job_caps.h"
#include "cam/job/read_job.h"
#include "cam/job/write_job.h"
#include "tests/cam/job/some_job.h"

namespace qchopper {
namespace {

using namespace test_pieces;

std::size_t count_of(const std::string& text, const std::string& word) {
    std::size_t count = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
    return count;
}

TEST(OrderSheets, TakesTheSheetOfAJobWithItsPictures) {
    JobInput input = tilting_job(3);
    input.caps = {capped(input, 3)};
    decide_holes(input.caps, {}, {}, "there is no program");
    const ReadJob job = parse_job(job_file(input), "AB.qjob");
    const SheetOfOrder sheet = sheet_of(job, "AB.qjob", "ready");
    EXPECT_EQ(sheet.piece, "AB");
    EXPECT_EQ(sheet.block_name, "flat");
    EXPECT_EQ(sheet.holes_by_hand, 3U);
    EXPECT_EQ(sheet.foam_mm3, 12345);
    EXPECT_EQ(sheet.unreachable_share, 0.05);
    EXPECT_NE(sheet.page.find("<h1>Setup sheet: piece AB (2 of 5)</h1>"), std::string::npos);
    for (const char* name : {"setup-1.png", "setup-2.png"}) {
        EXPECT_EQ(count_of(sheet.page, "src=\"data:image/png;base64," + to_base64(job.files.at(name)) + "\""), 1U);
        EXPECT_EQ(count_of(sheet.page, std::string("src=\"") + name), 0U);
    }
}

TEST(OrderSheets, HasAnIndexWithTotalsAndEverySheetOnce) {
    SheetOfOrder a;
    a.file = "A.qjob";
    a.state = "ready";
    a.piece = "A";
    a.block_name = "flat";
    a.block = {400, 300, 60};
    a.tools = {1, 7};
    a.time_s = 3600;
    a.unreachable_share = 0.0123;
    a.foam_mm3 = 1500;
    a.holes_by_hand = 2;
    a.page = "<p>the sheet of A</p>\n";
    SheetOfOrder b = a;
    b.file = "B.qjob";
    b.piece = "B";
    b.block_name = "tall <x>";
    b.tools = {3};
    b.part = {1, 2, {}};
    b.page = "<p>the sheet of B</p>\n";
    SheetOfOrder rest = b;
    rest.file = "B.p2.qjob";
    rest.part.number = 2;
    rest.page = "<p>the second sheet of B</p>\n";
    const std::vector<SheetOfOrder> sheets{a, b, rest};
    const PiecesWithoutJob without{{"C", "D"}, {"E"}};
    const std::string html = order_sheets("skull & co.ply", sheets, without);
    for (const char* text : {"<h1>Setup sheets: skull &amp; co.ply</h1>",
                             "<a href=\"#sheet-1\">A</a>",
                             "<a href=\"#sheet-2\">B, part 1 of 2</a>",
                             "<a href=\"#sheet-3\">B, part 2 of 2</a>",
                             "id=\"sheet-3\"",
                             "Without a job: C, D.",
                             "Sawn only, without a job: E.",
                             "the sheet of A",
                             "the sheet of B",
                             "the second sheet of B",
                             "B.p2.qjob",
                             "<td>pieces with a job</td><td>2</td>",
                             "<td>jobs</td><td>3</td>",
                             "<td>time, without setting up</td><td>3 h 00 min</td>",
                             "<td>blocks &quot;flat&quot;</td><td>1</td>",
                             "<td>blocks &quot;tall &lt;x&gt;&quot;</td><td>1</td>",
                             "<td>tools</td><td>1, 3, 7</td>",
                             "<td>foam to take off by hand</td><td>3.0 cm3</td>",
                             "<td>holes to drill by hand</td><td>4</td>",
                             "1.23"}) {
        EXPECT_EQ(count_of(html, text), text == std::string("1.23") ? 3U : 1U) << text << "\n" << html;
    }
    EXPECT_EQ(count_of(html, "<article"), 4U);
    EXPECT_EQ(count_of(html, "</article>"), 4U);
    EXPECT_EQ(html, order_sheets("skull & co.ply", sheets, without));
}

}  // namespace
}  // namespace qchopper
