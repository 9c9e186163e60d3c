#include "cam/job/sheet/setup_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cam/job/sheet/program_section.h"
#include "cam/job/sheet/setup_picture.h"
#include "cam/job/sheet/sheet_details.h"
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

TEST(SetupSheet, SaysWhatToDoInACellWithoutAMachine) {
    const std::string sheet = setup_sheet(some_job(), some_time_s);
    expect_words(sheet, {"<h1>Setup sheet: piece AB (2 of 5)</h1>", "Cell test.",
                         "Take block &quot;small&quot; (eps), 100 x 60 x 50 mm.", "Not sawn.",
                         "There is no spoil layer. Glue the base of the piece", "<li>scaled by 0.5 on request</li>",
                         "About 1 h 23 min. Crude: foam to remove over 24.0 cm3/s", "Written by qchopper 0.1.0."});
    EXPECT_EQ(row(sheet, "1 | ball"), "1 | ball | 20.0 | 18000 | 9000");
    EXPECT_EQ(row(sheet, "P1"),
              "P1 | corner of the block's top at -x, -y | -50.0 | -30.0 | 50.0 | -50.0 | -30.0 | 150.0");
    EXPECT_EQ(sheet.find("DO NOT START"), std::string::npos);
    EXPECT_EQ(sheet.find("unreachable&quot;"), std::string::npos);
    EXPECT_EQ(sheet.find("ignored"), std::string::npos);
    EXPECT_EQ(fault_of(sheet), "");
}

TEST(SheetDetails, OfACellWithoutAMachine) {
    const std::string details = sheet_details(some_job());
    expect_words(details, {"<h1>Details: piece AB (2 of 5)</h1>", "Arm not checked", "the cap of cut 4",
                           "<li>scaled by 0.5 on request</li>", "Other bases</h2>\n<p>None.</p>", "in one colour"});
    EXPECT_EQ(row(details, "limit"), "limit |  | none | ");
    EXPECT_EQ(row(details, "piece in block, height"), "piece in block, height | 25.7");
    EXPECT_EQ(fault_of(details), "");
}

TEST(SetupSheet, SaysWhatToDoInACellWithARobot) {
    const std::string sheet = setup_sheet(tilting_job(), some_time_s);
    expect_words(sheet,
                 {"</span> hidden, <span", "Take block &quot;flat&quot; (pu_foam), 400 x 300 x 60 mm.",
                  "Saw it down to 58 x 56 x 44 mm; a saw cut takes 3 mm",
                  "Offcuts that are left: 339 x 300 x 60, 58 x 241 x 60, 58 x 56 x 13 mm.",
                  "A turn by 1 degree moves the corners of the block by 0.7 mm.", "12.0 mm above the table",
                  "In the cell it is at (0.0, 0.0, 112.0).", "Clamps must stay within the lowest 12.0 mm",
                  "The state of this job is &quot;unreachable&quot;", "sent only if the foam that stays is accepted",
                  "Saw it off in the plane of its base, z = 0, 12.0 mm above the table",
                  "12.3 cm3 of foam stay there, up to 6.7 mm deep: take it off by hand."});
    EXPECT_EQ(row(sheet, "P3"),
              "P3 | corner of the block's top at -x, +y | -29.0 | 28.0 | 32.0 | -29.0 | 28.0 | 144.0");
    EXPECT_EQ(fault_of(sheet), "");
}

TEST(SheetDetails, TellTheFiguresOfATiltingTool) {
    const std::string details = sheet_details(tilting_job());
    expect_words(details, {"Base 2: the cap of cut 4", "6.2 % of the triangles", "Arm not checked",
                           "</span> ignored: 1.2 cm2, may stay", "</span> too narrow: 0.4 cm2, the smallest tool"});
    EXPECT_EQ(row(details, "1 | 0.0"), "1 | 0.0 | any | 75.0 | 21.5");
    EXPECT_EQ(row(details, "2 | 45"), "2 | 45.0 | 90.0 | 12.5 | 30.2");
    EXPECT_EQ(row(details, "worth adding"), "worth adding | 90.0 | 180.0 | 1.0 | 12.0");
    EXPECT_EQ(row(details, "hidden"), "hidden | 0.5 | 2.50 | in sight of no direction");
    EXPECT_EQ(row(details, "steep"), "steep | 0.2 | 1.00 | within 3 degrees of a direction");
    EXPECT_EQ(row(details, "holder"), "holder | 0.3 | 1.50 | the tool is too short: its holder would touch");
    EXPECT_EQ(row(details, "unreachable together"), "unreachable together | 1.0 | 5.00 | ");
    EXPECT_EQ(row(details, "limit"), "limit |  | 2.00 | ");
    EXPECT_EQ(row(details, "where no tool"), "where no tool in these orientations reaches | 12.3 | 6.7");
    EXPECT_EQ(row(details, "rest material"), "rest material of the smallest tool's radius, besides | 0.9 | ");
    EXPECT_EQ(row(details, "1 | without"),
              "1 | without a cap, lying on its side | height maps | 22.50 | 12.3 | 0.9 | 58 x 56 x 44 | 2");
    EXPECT_EQ(row(details, "3 | without"),
              "3 | without a cap, lying on its side | samples | 22.50 | - | - | 58 x 56 x 44 | 2");
    EXPECT_EQ(fault_of(details), "");
}

// All shares that a text states, as "5.00 %".
std::set<std::string> shares_in(const std::string& text) {
    std::set<std::string> shares;
    for (std::size_t at = text.find(" %"); at != std::string::npos; at = text.find(" %", at + 1)) {
        const std::size_t begin = text.find_last_not_of("0123456789.", at - 1) + 1;
        shares.insert(text.substr(begin, at - begin));
    }
    return shares;
}

TEST(SetupSheet, HasOneFigureForWhatIsOutOfReach) {
    const std::string sheet = setup_sheet(tilting_job(), some_time_s);
    expect_words(sheet, {"Out of reach of the tool: 5.00 % of the surface, limit 2.00 %."});
    EXPECT_EQ(shares_in(sheet), (std::set<std::string>{"5.00", "2.00"}));
    // Of the parts that the details list the sum is the same figure.
    const std::string details = sheet_details(tilting_job());
    EXPECT_EQ(details.find("92.80"), std::string::npos) << "what is left without counting some of it";
    EXPECT_EQ(details.find("1.25"), std::string::npos) << "what other directions would leave";
}

TEST(SetupSheet, ListsTheToolsThatTheProgramTakesAndNoOther) {
    JobInput input = tilting_job();
    CuttingTool third = input.cell.machine->tools[0];
    third.number = 9;
    third.name = "left in the rack";
    input.cell.machine->tools.push_back(third);
    const auto rows_of = [&](std::vector<std::uint16_t> used) {
        input.program = ProgramInput{};
        input.program->proof.figures = {{"max_gouge_mm", "largest gouge", 0.125, "mm", 3}};
        input.program->tools = std::move(used);
        const std::string sheet = setup_sheet(input, some_time_s);
        return std::vector<std::string>{row(sheet, "1 | long"), row(sheet, "7 |"), row(sheet, "9 |")};
    };
    const std::string first = "1 | long ball | ball | 20.0 | 180.0 | 18000 | 150.0 | measured";
    const std::string second =
        "7 | fine &lt;cone&gt; | cone | 6.0 | 92.5 | 18000 | 150.0 | NOT MEASURED: measure it first";
    EXPECT_EQ(rows_of({7, 1, 7}), (std::vector<std::string>{first, second, "no row 9 |"}));
    EXPECT_EQ(rows_of({7}), (std::vector<std::string>{"no row 1 | long", second, "no row 9 |"}));
    input.program.reset();
    const std::string sheet = setup_sheet(input, some_time_s);
    EXPECT_EQ(row(sheet, "1 | long"), first) << "the ticket names the first tool";
    EXPECT_EQ(row(sheet, "9 |"), "no row 9 |");
}

TEST(SheetDetails, SayWhereTheMachineTimeGoes) {
    JobInput input = tilting_job();
    input.program = ProgramInput{};
    EXPECT_EQ(row(sheet_details(input), "fine finishing"), "no row fine finishing") << "nothing was replayed";
    MachineTime time;
    time.operation = "fine finishing";
    time.tool = 7;
    time.tool_mm3_per_s = 24'000;
    time.cutting_s = 600;
    time.air_s = 300;
    time.link_s = 60;
    time.acceleration_s = 240;
    time.joint_move_s = 30;
    time.tool_change_s = 120;
    time.removed_mm3 = 2.4e6;
    input.program->proof.time = {time};
    EXPECT_EQ(row(sheet_details(input), "fine finishing"),
              "fine finishing | 7 | 10.0 | 5.0 | 1.0 | 4.0 | 0.5 | 2.0 | 22.5 | 2.40 | 2.0 | 24.0");
}

TEST(SheetDetails, NameToolsThatStickOutFar) {
    JobInput input = tilting_job();
    input.program = ProgramInput{};
    const auto use = [&](std::uint16_t tool, std::size_t orientation) {
        JobChunk chunk;
        chunk.tool = tool;
        chunk.orientation = orientation;
        input.program->program.chunks.push_back(chunk);
    };
    use(1, 0);
    EXPECT_EQ(sheet_details(input).find("watch for chatter"), std::string::npos) << "9 diameters";
    use(7, 1);
    use(7, 0);
    use(7, 1);
    EXPECT_NE(
        sheet_details(input).find("Tool 7 sticks out by 15.4 diameters, in orientations 1, 2: watch for chatter."),
        std::string::npos);
}

// The size that a tag states; {0, 0} without one.
std::pair<int, int> size_in(const std::string& tag) {
    const auto value = [&](const std::string& name) {
        const std::size_t at = tag.find(" " + name + "=\"");
        return at == std::string::npos ? 0 : std::stoi(tag.substr(at + name.size() + 3));
    };
    return {value("width"), value("height")};
}

// A browser that makes a picture narrower keeps its height unless the style says otherwise.
TEST(SetupSheet, StatesTheSizeOfItsPicturesAndLetsThemShrinkInBothDirections) {
    JobInput input = placed_job();
    input.program = ProgramInput{};
    input.program->deviation_picture = {1};
    const std::map<std::string, std::pair<int, int>> sizes{
        {"setup-1.png", {setup_picture_width, setup_picture_height}},
        {"setup-2.png", {setup_picture_width, setup_picture_height}},
        {"deviation.png", {deviation_picture_width, deviation_picture_height}},
        {"envelope.png", {1000, 750}}};
    std::size_t found = 0;
    for (const std::string& html : {setup_sheet(input, some_time_s), sheet_details(input)}) {
        EXPECT_NE(html.find("img { max-width: 100%; height: auto; }"), std::string::npos);
        for (std::size_t at = html.find("<img "); at != std::string::npos; at = html.find("<img ", at + 1)) {
            const std::string tag = html.substr(at, html.find('>', at) - at);
            const std::size_t name = tag.find("src=\"") + 5;
            const auto known = sizes.find(tag.substr(name, tag.find('"', name) - name));
            ASSERT_NE(known, sizes.end()) << tag;
            EXPECT_EQ(size_in(tag), known->second) << tag;
            EXPECT_EQ(tag.find("style="), std::string::npos) << tag;
            ++found;
        }
    }
    EXPECT_EQ(found, sizes.size());
}

TEST(SetupSheet, LeavesTheRestOfALongListToTheDetails) {
    JobInput input = some_job();
    for (int i = 0; i < 30; ++i) input.warnings.push_back("warning " + std::to_string(i) + std::string(400, 'x'));
    const std::string sheet = setup_sheet(input, some_time_s);
    expect_words(sheet, {"<li>warning 2xxx", "x...</li>", "<li>27 more in details.html</li>"});
    EXPECT_EQ(sheet.find("warning 3x"), std::string::npos);
    expect_words(sheet_details(input), {"warning 29" + std::string(400, 'x')});
}

TEST(SetupSheet, TellsByWhichFormulaThePieceIsHeld) {
    JobInput input = tilting_job();
    std::string sheet = setup_sheet(input, some_time_s);
    EXPECT_EQ(row(sheet, "tape or glue of"), "tape or glue of 0.1 N/mm2 | F = s k^3 W / (h + t) | 45.5 | 20.0 | yes");
    EXPECT_EQ(row(sheet, "foam of 0.6"),
              "foam of 0.6 N/mm2, 24.0 cm2 at z = 2.5 | F = b W(z) / (h - z) | 160.2 | 20.0 | yes");
    expect_words(sheet, {"Slenderness: 32.0 mm high on a base of 25.0 cm2 that is 50.0 mm wide at least"});
    expect_words(sheet_details(input), {"t = 12.0 mm: spoil layer"});
    EXPECT_EQ(sheet.find("not held safely"), std::string::npos);

    input.setup.workholding->foam_force = 2.25;
    input.setup.workholding->stand = HoldingStand{11, 65, -3, 4};
    sheet = setup_sheet(input, some_time_s);
    expect_words(sheet,
                 {"<p class=\"stop\">The piece is not held safely: foam of 0.6 N/mm2 breaks at 2.2 N, less than the "
                  "cutting force of 20 N, where 24.0 cm2 stand 2 mm above the base. See 3. Holding.",
                  "To do: leave a stand of uncut foam around its lowest 11 mm, 65 x 65 mm about x = -3, y = 4 of "
                  "the setup, saw it off in the plane of the base (z = 0)"});
    EXPECT_EQ(fault_of(sheet), "");
    EXPECT_EQ(setup_sheet(some_job(), some_time_s).find("cutting force"), std::string::npos) << "no machine";
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
    input.stock_fit.margins[0].mm = -12;
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
    input.stock_fit.margins[0] = {evil, evil, -1};
    input.program_version = evil;
    for (const std::string& sheet : {setup_sheet(input, some_time_s), sheet_details(input)}) {
        EXPECT_EQ(sheet.find("<script"), std::string::npos);
        EXPECT_EQ(sheet.find('\xff'), std::string::npos);
        EXPECT_EQ(fault_of(sheet), "");
    }
}

TEST(SetupSheet, NothingComesFromElsewhere) {
    const std::string sheet = setup_sheet(tilting_job(), some_time_s);
    for (const char* word : {"http", "url(", "@import", "<script", "<link", "onload"}) {
        EXPECT_EQ(sheet.find(word), std::string::npos) << word;
        EXPECT_EQ(sheet_details(tilting_job()).find(word), std::string::npos) << word;
    }
    expect_words(sheet, {"<img src=\"setup-1.png\"", "<img src=\"setup-2.png\"", "@page { size: A4;"});
    EXPECT_EQ(sheet, setup_sheet(tilting_job(), some_time_s));
}

}  // namespace
}  // namespace qchopper
