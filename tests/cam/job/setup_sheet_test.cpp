#include "cam/job/setup_sheet.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/cam/job/some_job.h"

namespace qchopper {
namespace {

using namespace test_pieces;

constexpr std::uint32_t some_time_s = 5000;

void expect_words(const std::string& sheet, const std::vector<std::string>& wanted) {
    for (const std::string& words : wanted) EXPECT_NE(sheet.find(words), std::string::npos) << words << "\n" << sheet;
}

// The row of a table that begins with a text, without tags: entries joined by " | ".
std::string row(const std::string& sheet, const std::string& first) {
    for (std::size_t at = sheet.find("<tr>"); at != std::string::npos; at = sheet.find("<tr>", at + 1)) {
        std::string text = sheet.substr(at, sheet.find("</tr>", at) - at);
        for (std::size_t end = text.find("</td>"); end != std::string::npos; end = text.find("</td>")) {
            text.replace(end, 5, text.ends_with("</td>") && end + 5 == text.size() ? "" : " | ");
        }
        for (std::size_t tag = text.find('<'); tag != std::string::npos; tag = text.find('<')) {
            text.erase(tag, text.find('>', tag) - tag + 1);
        }
        text.erase(0, text.find_first_not_of(' '));
        if (text.starts_with(first)) return text;
    }
    return "no row " + first;
}

// What is wrong with the nesting of the tags; nothing if every one is closed.
std::string fault_of(const std::string& html) {
    const std::set<std::string> without_end{"!DOCTYPE", "meta", "img"};
    std::vector<std::string> open;
    for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
        const std::size_t end = html.find('>', at);
        if (end == std::string::npos) return "a tag without an end";
        const std::string tag = html.substr(at + 1, end - at - 1);
        const std::string name = tag.substr(0, tag.find_first_of(" \n"));
        if (without_end.contains(name)) continue;
        if (!name.starts_with('/')) {
            open.push_back(name);
        } else if (open.empty() || "/" + open.back() != name) {
            return name + " closes " + (open.empty() ? "nothing" : open.back());
        } else {
            open.pop_back();
        }
    }
    return open.empty() ? "" : open.back() + " is not closed";
}

TEST(SetupSheet, SaysWhatToDoInACellOfVersion1) {
    const std::string sheet = setup_sheet(some_job(), some_time_s);
    expect_words(sheet, {"<h1>Setup sheet: piece AB (2 of 5)</h1>", "Cell test.",
                         "Take block &quot;small&quot; (eps), 100 x 60 x 50 mm.", "Not sawn.", "Arm not checked",
                         "There is no spoil layer. Glue the base of the piece", "the cap of cut 4",
                         "<li>scaled by 0.5 on request</li>", "About 1 h 23 min. Crude: foam to remove over 24.0 cm3/s",
                         "Other bases</h2>\n<p>None.</p>", "Written by qchopper 0.1.0."});
    EXPECT_NE(sheet.find("in one colour"), std::string::npos) << "no states of the triangles are given";
    EXPECT_EQ(row(sheet, "limit"), "limit |  | none |  | ");
    EXPECT_EQ(row(sheet, "1 | ball"), "1 | ball | 20.0 | 18000 | 9000");
    EXPECT_EQ(row(sheet, "P1"),
              "P1 | corner of the block's top at -x, -y | -50.0 | -30.0 | 50.0 | -50.0 | -30.0 | 150.0");
    EXPECT_EQ(row(sheet, "piece in block, height"), "piece in block, height | 25.7");
    EXPECT_EQ(sheet.find("DO NOT START"), std::string::npos);
    EXPECT_EQ(sheet.find("unreachable&quot;"), std::string::npos);
    EXPECT_EQ(sheet.find("ignored"), std::string::npos);
    EXPECT_EQ(fault_of(sheet), "");
}

TEST(SetupSheet, TellsTheFiguresOfATiltingTool) {
    const std::string sheet = setup_sheet(tilting_job(), some_time_s);
    expect_words(
        sheet,
        {"</span> hidden, <span", "Take block &quot;flat&quot; (pu_foam), 400 x 300 x 60 mm.",
         "Saw it down to 58 x 56 x 44 mm; a saw cut takes 3 mm",
         "A turn by 1 degree moves the corners of the block by 0.7 mm.", "12.0 mm above the table",
         "In the cell it is at (0.0, 0.0, 112.0).", "Clamps must stay within the lowest 12.0 mm",
         "Base 2: the cap of cut 4", "6.2 % of the triangles", "Arm not checked",
         "The state of this job is &quot;unreachable&quot;: the tool does not reach 5.00 % of the surface",
         "of the surface, and the limit is 2.00 %.", "only with --accept-unreachable",
         "Saw it off in the plane of its base, z = 0, 12.0 mm above the table",
         "With all directions that can be held, 1.25 % of the surface", "</span> ignored: 1.2 cm2 that may stay"});
    EXPECT_EQ(row(sheet, "1 | 339"), "1 | 339.0 | 300.0 | 60.0");
    EXPECT_EQ(row(sheet, "P3"),
              "P3 | corner of the block's top at -x, +y | -29.0 | 28.0 | 32.0 | -29.0 | 28.0 | 144.0");
    EXPECT_EQ(row(sheet, "1 | long"), "1 | long ball | ball | 20.0 | 180.0 | 18000 | 150.0 | measured");
    EXPECT_EQ(row(sheet, "7 |"),
              "7 | fine &lt;cone&gt; | cone | 6.0 | 92.5 | 18000 | 150.0 | NOT MEASURED: measure it first");
    EXPECT_EQ(row(sheet, "1 | 0.0"), "1 | 0.0 | any | 75.0 | 21.5");
    EXPECT_EQ(row(sheet, "2 | 45"), "2 | 45.0 | 90.0 | 12.5 | 30.2");
    EXPECT_EQ(row(sheet, "worth adding"), "worth adding | 90.0 | 180.0 | 1.0 | 12.0");
    EXPECT_EQ(row(sheet, "reached"), "reached | 18.6 | 92.80 |  | ");
    EXPECT_EQ(row(sheet, "hidden"), "hidden | 0.5 | 2.50 | yes | in sight of no direction");
    EXPECT_EQ(row(sheet, "steep"), "steep | 0.2 | 1.00 | yes | within 3 degrees of a direction");
    EXPECT_EQ(row(sheet, "holder"), "holder | 0.3 | 1.50 | yes | the tool is too short: its holder would touch");
    EXPECT_EQ(row(sheet, "too narrow"), "too narrow | 0.4 | 2.20 | does not count | the smallest tool does not fit in");
    EXPECT_EQ(row(sheet, "unreachable together"), "unreachable together | 1.0 | 5.00 |  | ");
    EXPECT_EQ(row(sheet, "limit"), "limit |  | 2.00 |  | ");
    EXPECT_EQ(row(sheet, "where no tool"), "where no tool of these directions reaches | 12.3 | 6.7");
    EXPECT_EQ(row(sheet, "residue"), "residue of the smallest tool's radius, besides | 0.9 | ");
    EXPECT_EQ(row(sheet, "1 | without"),
              "1 | without a cap, lying on its side | height maps | 22.50 | 12.3 | 0.9 | 58 x 56 x 44 | 2");
    EXPECT_EQ(row(sheet, "3 | without"),
              "3 | without a cap, lying on its side | samples | 22.50 | - | - | 58 x 56 x 44 | 2");
    EXPECT_EQ(fault_of(sheet), "");
}

TEST(SetupSheet, SaysHowExactlyTheBlockMustLie) {
    JobInput input = tilting_job();
    input.setup.box = {{-20, -10, 0}, {20, 10, 20}};
    input.setup.block.size.z = 44.26;
    expect_words(setup_sheet(input, some_time_s),
                 {"the foam around the piece is what the block may be off, 9.0 mm along x "
                  "and 18.0 mm along y.",
                  "58 x 56 x 44.3 mm along x, y and z"});
}

TEST(SetupSheet, SaysDoNotStart) {
    JobInput input = some_job();
    input.envelope.margins[0].mm = -12;
    expect_words(setup_sheet(input, some_time_s), {"DO NOT START: piece AB does not fit: 12 mm too long"});
}

TEST(SetupSheet, EveryTextIsEscaped) {
    JobInput input = tilting_job();
    const std::string evil = "<script>\"&'</td>\xff\x01";
    input.piece.name = evil;
    input.cell.name = evil;
    input.cell.stock[1].name = evil;
    input.cell.machine->tools[0].name = evil;
    input.setup.base_description = evil;
    input.setup.warnings = {evil};
    input.warnings = {evil};
    input.alternatives[0].base_description = evil;
    input.envelope.margins[0] = {evil, evil, -1};
    input.program_version = evil;
    const std::string sheet = setup_sheet(input, some_time_s);
    EXPECT_EQ(sheet.find("<script"), std::string::npos);
    EXPECT_EQ(sheet.find('\xff'), std::string::npos);
    EXPECT_EQ(fault_of(sheet), "");
}

TEST(SetupSheet, NothingComesFromElsewhere) {
    const std::string sheet = setup_sheet(tilting_job(), some_time_s);
    for (const char* word : {"http", "url(", "@import", "<script", "<link", "onload"}) {
        EXPECT_EQ(sheet.find(word), std::string::npos) << word;
    }
    expect_words(sheet, {"<img src=\"setup-1.png\"", "<img src=\"setup-2.png\"", "@page { size: A4;"});
    EXPECT_EQ(sheet, setup_sheet(tilting_job(), some_time_s));
}

}  // namespace
}  // namespace qchopper
