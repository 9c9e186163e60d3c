// What a line states, or does not state, and the foam does not show: signals, load data, speeds, home. Each fault is
// found with the line where it stands.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "sim/replay/replay.h"
#include "tests/sim/replay/box_job.h"
#include "tests/sim/replay/mutations.h"

namespace qchopper {
namespace {

const std::string main_file = "qc_1.src";
const std::string last_chunk = "qc_1_002.src";
const std::string call_of_last = "qc_1_002( )";

ReplayReport replayed(const BoxJob& job, const ProgramFiles& files, const Box* block = nullptr) {
    ReplayOptions options;
    options.cell = 1;
    options.volume_cell = 2;
    options.leftover.reach_cell = 1;
    options.leftover.sample_mm = 8;
    ReplayScene scene = job.scene();
    if (block != nullptr) scene.block = *block;
    return replay(read_back(job, files), scene, options);
}

std::string& text_of(ProgramFiles& files, const std::string& name) {
    for (ProgramFile& file : files) {
        if (file.name == name) return file.text;
    }
    throw std::out_of_range(name);
}

// Replaces the first place behind `behind`.
void put(std::string& text, const std::string& from, const std::string& to, const std::string& behind = {}) {
    const std::size_t at = text.find(from, text.find(behind));
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
}

void put_all(ProgramFiles& files, const std::string& from, const std::string& to) {
    for (ProgramFile& file : files) {
        for (std::size_t at = file.text.find(from); at != std::string::npos;
             at = file.text.find(from, at + to.size())) {
            file.text.replace(at, from.size(), to);
        }
    }
}

std::string line_at(const std::string& text, std::size_t number) {
    std::size_t at = 0;
    for (std::size_t i = 1; i < number; ++i) at = text.find('\n', at) + 1;
    return text.substr(at, text.find('\r', at) - at);
}

struct Fault {
    const char* name;
    std::function<void(ProgramFiles&)> make;
    FindingKind kind;
    std::string file;
    std::string line;  // its beginning
    std::string text;  // part of the finding
};

void add_line(ProgramFiles& files, const std::string& file, const std::string& before, const std::string& line) {
    put(text_of(files, file), before, line + "\r\n" + before);
}

std::vector<Fault> of_signals() {
    return {
        {"a chunk that does not start the spindle",
         [](ProgramFiles& f) { put(text_of(f, last_chunk), "$OUT[1] = TRUE\r\nWAIT FOR $IN[1]\r\n", ""); },
         FindingKind::spindle_off, last_chunk, "LIN", "has not switched the spindle on"},
        {"a chunk that does not wait", [](ProgramFiles& f) { put(text_of(f, last_chunk), "WAIT FOR $IN[1]\r\n", ""); },
         FindingKind::spindle_off, last_chunk, "LIN", "waited for the speed"},
        {"a chunk that states no speed",
         [](ProgramFiles& f) { put(text_of(f, last_chunk), "$ANOUT[1] = 0.83333\r\n", ""); },
         FindingKind::spindle_speed, last_chunk, "LIN", "0 revolutions/min"},
        {"extraction never on", [](ProgramFiles& f) { put_all(f, "$OUT[2] = TRUE\r\n", ""); },
         FindingKind::extraction_off, "qc_1_001.src", "LIN", "has not switched extraction on"},
        {"a chunk that does not start extraction",
         [](ProgramFiles& f) { put(text_of(f, last_chunk), "$OUT[2] = TRUE\r\n", ""); }, FindingKind::extraction_off,
         last_chunk, "LIN", "has not switched extraction on"},
        {"extraction off before the last level",
         [](ProgramFiles& f) { add_line(f, last_chunk, "LIN {X -50.00,Y -35.00,Z -2.00}", "$OUT[2] = FALSE"); },
         FindingKind::extraction_off, last_chunk, "LIN {X -50.00,Y -35.00,Z -2.00}", ""},
        {"the spindle on at the end",
         [](ProgramFiles& f) { put(text_of(f, main_file), "$OUT[1] = FALSE\r\n", "", call_of_last); },
         FindingKind::left_on, main_file, "END",
         "the spindle is still on at the end, expected before: $OUT[1] = FALSE"},
        {"extraction on at the end",
         [](ProgramFiles& f) { put(text_of(f, main_file), "$OUT[2] = FALSE\r\n", "", call_of_last); },
         FindingKind::left_on, main_file, "END", "extraction is still on at the end, expected before: $OUT[2] = FALSE"},
        {"the spindle on at a stop", [](ProgramFiles& f) { add_line(f, main_file, ";ASK", "$OUT[1] = TRUE"); },
         FindingKind::tool_change, main_file, "HALT", "the spindle is still on at this stop"},
        {"extraction on at a stop", [](ProgramFiles& f) { add_line(f, main_file, ";ASK", "$OUT[2] = TRUE"); },
         FindingKind::tool_change, main_file, "HALT", "extraction is still on at this stop"},
        {"an output of nobody", [](ProgramFiles& f) { add_line(f, last_chunk, "$OUT[2]", "$OUT[77] = TRUE"); },
         FindingKind::unknown_signal, last_chunk, "$OUT[77]", "$OUT[77]"},
        {"an analogue output of nobody", [](ProgramFiles& f) { add_line(f, last_chunk, "$OUT[2]", "$ANOUT[5] = 0.1"); },
         FindingKind::unknown_signal, last_chunk, "$ANOUT[5]", "$ANOUT[5]"},
        {"an input of nobody", [](ProgramFiles& f) { add_line(f, last_chunk, "$OUT[2]", "WAIT FOR $IN[9]"); },
         FindingKind::unknown_signal, last_chunk, "WAIT FOR $IN[9]", "$IN[9]"},
    };
}

std::vector<Fault> of_values() {
    return {
        {"acceleration times ten", [](ProgramFiles& f) { put_all(f, "$ACC.CP = 2.0000", "$ACC.CP = 20.0000"); },
         FindingKind::motion_limit, "qc_1_001.src", "LIN", "$ACC.CP is 20.00 m/s2 here, the cell file allows 2.00"},
        {"orientation times ten",
         [](ProgramFiles& f) { put(text_of(f, last_chunk), "$VEL.ORI2 = 90.0", "$VEL.ORI2 = 900.0"); },
         FindingKind::motion_limit, last_chunk, "LIN", "$VEL.ORI2 is 900.00 degrees/s here, the cell file allows 100"},
        {"joint moves at full speed",
         [](ProgramFiles& f) { put(text_of(f, last_chunk), "$VEL_AXIS[2] = 30", "$VEL_AXIS[2] = 100"); },
         FindingKind::motion_limit, last_chunk, "PTP", "$VEL_AXIS[2] is 100.00 % here, the cell file allows 50"},
        {"load centre 300 mm off", [](ProgramFiles& f) { put(text_of(f, last_chunk), "CM {X 0.000", "CM {X 300.000"); },
         FindingKind::load, last_chunk, "PTP", "kg at 300.0 0.0"},
        {"load too light", [](ProgramFiles& f) { put(text_of(f, last_chunk), "{M 16.20", "{M 15.50"); },
         FindingKind::load, last_chunk, "PTP", "15.50 kg"},
        {"inertia of another load", [](ProgramFiles& f) { put(text_of(f, last_chunk), "J {X 0.", "J {X 2."); },
         FindingKind::load, last_chunk, "PTP", "kg m2"},
        {"load of the way home", [](ProgramFiles& f) { put(text_of(f, main_file), "{M 16.20", "{M 61.20"); },
         FindingKind::load, main_file, "PTP", "61.20 kg"},
        {"tool turned about its axis",
         [](ProgramFiles& f) { put(text_of(f, last_chunk), "A 0.0000", "A 5.0000", "$TOOL"); }, FindingKind::tool_frame,
         last_chunk, "LIN", "5.000 degrees"},
        {"begins elsewhere", [](ProgramFiles& f) { put(text_of(f, main_file), "PTP {A1 0.000", "PTP {A1 3.000"); },
         FindingKind::not_home, main_file, "PTP", "the first move does not lead home"},
        {"ends elsewhere",
         [](ProgramFiles& f) { put(text_of(f, main_file), "PTP {A1 0.000", "PTP {A1 3.000", call_of_last); },
         FindingKind::not_home, main_file, "END", "does not end at home"},
        {"a stop elsewhere",
         [](ProgramFiles& f) {
             std::string& text = text_of(f, main_file);
             const std::size_t at = text.find("PTP");
             std::string away = text.substr(at, text.find('\n', at) + 1 - at);
             put(away, "A1 0.000", "A1 3.000");
             put(text, ";ASK", away + ";ASK");
         },
         FindingKind::not_home, main_file, "HALT", "not at home at this stop"},
        {"a wrong length in the question",
         [](ProgramFiles& f) { put(text_of(f, main_file), "200.00 mm", "190.00 mm"); }, FindingKind::tool_change,
         main_file, "HALT", "expected: 200.00 mm"},
        {"another tool in the question",
         [](ProgramFiles& f) { put(text_of(f, main_file), "(flat end 20 mm)", "(ball nose 20 mm)"); },
         FindingKind::tool_change, main_file, "HALT", "expected: (flat end 20 mm)"},
    };
}

void expect_found(const Fault& fault) {
    const BoxJob job = box_job("kr60-ha");
    ProgramFiles files = job.files();
    fault.make(files);
    const ReplayReport report = replayed(job, files);
    const ParsedProgram program = read_back(job, files);
    bool is_found = false;
    std::string others;
    for (const Finding& finding : report.findings) {
        others += finding.text + "\n";
        if (finding.kind != fault.kind || finding.place.line == 0) continue;
        const std::string& file = program.files[finding.place.file];
        const std::string line = line_at(text_of(files, file), finding.place.line);
        is_found |=
            file == fault.file && line.starts_with(fault.line) && finding.text.find(fault.text) != std::string::npos;
    }
    EXPECT_TRUE(is_found) << fault.name << ", found:\n" << others;
}

TEST(StatedValues, OfSignalsAreFoundWhereTheyStand) {
    for (const Fault& fault : of_signals()) expect_found(fault);
}

TEST(StatedValues, OfLoadSpeedsAndHomeAreFoundWhereTheyStand) {
    for (const Fault& fault : of_values()) expect_found(fault);
}

// The same programs in cells that allow it.
TEST(StatedValues, AreHeldAgainstTheCellFile) {
    BoxJob job = box_job("kr60-ha");
    ProgramFiles files = job.files();
    put_all(files, "$ACC.CP = 2.0000", "$ACC.CP = 5.0000");
    put_all(files, "$VEL_AXIS[1] = 30", "$VEL_AXIS[1] = 80");
    put_all(files, "CM {X 0.000", "CM {X 40.000");
    put_all(files, "$OUT[2] = TRUE\r\n", "");
    put_all(files, "$OUT[2] = FALSE\r\n", "");
    EXPECT_FALSE(replayed(job, files).is_good);
    CellMachine& machine = *job.cell.machine;
    machine.program.acceleration = 5000;
    machine.program.joint_share = 0.8;
    machine.load_tolerance.centre_mm = 41;
    machine.extraction.reset();
    const ReplayReport report = replayed(job, files);
    EXPECT_TRUE(report.is_good) << report.findings.front().text;
}

TEST(StatedValues, AStartFromHomeThatIsNotFreeIsFound) {
    const BoxJob job = box_job("kr60-ha");
    ProgramFiles files = job.files();
    add_line(files, last_chunk, "$VEL_AXIS[1]", ";start from home: free");
    EXPECT_TRUE(replayed(job, files).is_good);
    // The first chunk has milled a pit in it, into which the tool does not come from home along a straight line.
    const Box large{{-200, -200, -10}, {200, 200, 400}};
    const ReplayReport report = replayed(job, files, &large);
    const auto found = std::find_if(report.findings.begin(), report.findings.end(),
                                    [](const Finding& f) { return f.kind == FindingKind::start_from_home; });
    ASSERT_NE(found, report.findings.end());
    EXPECT_EQ(line_at(text_of(files, last_chunk), found->place.line), ";start from home: free");
}

}  // namespace
}  // namespace qchopper
