// The setup sheet as a browser shows and prints it. Where there is no Chromium these tests are skipped;
// setup_sheet_test.cpp holds the text.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/files/file.h"
#include "cam/job/job_caps.h"
#include "cam/job/read_job.h"
#include "cam/job/sheet/order_sheets.h"
#include "cam/job/write_job.h"
#include "tests/cam/job/some_job.h"
#include "tests/folder.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using namespace test_pieces;

// Empty where there is none.
std::string browser() {
    const char* path = std::getenv("PATH");
    std::string folders = path == nullptr ? "" : path;
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
        for (std::size_t from = 0; from <= folders.size();) {
            const std::size_t end = std::min(folders.find(':', from), folders.size());
            const fs::path file = fs::path(folders.substr(from, end - from)) / name;
            if (::access(file.c_str(), X_OK) == 0) return file.string();
            from = end + 1;
        }
    }
    return {};
}

// What the browser writes to stdout; it has its profile in the folder.
std::string browse(const std::string& options, const fs::path& html, const Folder& folder) {
    const fs::path out = folder.path / "out";
    const std::string command = "timeout 100 \"" + browser() +
                                "\" --headless --no-sandbox --disable-gpu --user-data-dir=\"" +
                                (folder.path / "profile").string() + "\" " + options + " \"file://" + html.string() +
                                "\" >\"" + out.string() + "\" 2>\"" + (folder.path / "err").string() + "\" </dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0) << command << text_of(read_file(folder.path / "err", settings_limit));
    return text_of(read_file(out, record_limit));
}

// How often a PDF of the browser has a page.
std::size_t pages_of(const fs::path& html, const Folder& folder) {
    const fs::path pdf = folder.path / "sheet.pdf";
    browse("--no-pdf-header-footer --print-to-pdf=\"" + pdf.string() + "\"", html, folder);
    const std::string text = text_of(read_file(pdf, record_limit));
    std::size_t pages = 0;
    for (std::size_t at = text.find("/Type /Page\n"); at != std::string::npos;
         at = text.find("/Type /Page\n", at + 1)) {
        ++pages;
    }
    EXPECT_NE(text.find("/MediaBox [0 0 59"), std::string::npos) << "A4";
    return pages;
}

// More than what a person at a cell meets: everything that makes the sheet longer at once.
JobInput long_job() {
    JobInput input = placed_job();
    input.max_unreachable = 0.02;
    input.setup.access = some_access(input);
    input.setup.spoil = 12;
    input.setup.block.is_sawn = true;
    input.setup.block.offcuts = {{339.5, 300.5, 60.5}, {58.5, 241.5, 60.5}, {58.5, 56.5, 13.5}};
    input.setup.placement.turn = 0.3;
    input.cell.name = std::string(60, 'W');
    if (!input.setup.workholding) ADD_FAILURE() << "the cell tells strengths";
    input.setup.workholding->joint_force = 1;
    input.setup.workholding->foam_force = 1;
    input.setup.workholding->base_width = 2;
    input.states.assign(input.piece.mesh->triangles.size(), SurfaceState::hidden);
    input.caps = {capped(input, 4)};
    decide_holes(input.caps, {}, {}, "the piece stands over it");
    ProgramInput program;
    program.program.entry = "qc_2.src";
    program.program.files = {"qc_2.src", "qc_2_001.src"};
    program.program.chunks = {{"qc_2_001.src", 1, 0, 120, 4567.25, {{-1, -2, 0}, {3, 4, 60}}, {0, 0, 60}, {1, 1, 60}}};
    program.program.part = {2, 3, sha256({})};
    program.stock = {1};
    program.proof.findings = {{"leftover", "", 0, std::string(500, 'x')}};
    for (const std::string& name : program.program.files) program.texts[name] = "DEF\r\nEND\r\n";
    std::vector<CuttingTool>& tools = input.cell.machine->tools;
    while (tools.size() < 6) tools.push_back(tools.front());
    for (std::size_t i = 0; i < tools.size(); ++i) {
        tools[i].number = static_cast<std::uint16_t>(i + 1);
        tools[i].name = "a tool of a rather long name, " + std::to_string(i);
        program.tools.push_back(tools[i].number);
    }
    input.program = program;
    for (int i = 0; i < 9; ++i) input.warnings.push_back("the scan was smoothed: " + std::string(300, 'w'));
    return input;
}

// The files of a job, unpacked.
fs::path unpacked(const JobInput& input, const Folder& folder) {
    for (const auto& [name, bytes] : parse_job(job_file(input), "AB.qjob").files) write_file(folder.path / name, bytes);
    return folder.path / "setup.html";
}

TEST(SheetPages, TheSheetIsOnePageOfA4) {
    if (browser().empty()) GTEST_SKIP() << "skipped: no Chromium here";
    const JobInput inputs[] = {some_job(), tilting_job(), placed_job(), long_job()};
    for (const JobInput& input : inputs) {
        const Folder folder;
        EXPECT_EQ(pages_of(unpacked(input, folder), folder), 1U) << input.cell.name;
    }
}

// Width over height as drawn, against that of the file, in a narrow window and in a wide one.
TEST(SheetPages, NoPictureIsStretched) {
    if (browser().empty()) GTEST_SKIP() << "skipped: no Chromium here";
    const Folder folder;
    unpacked(long_job(), folder);
    const std::string measure =
        "<script>onload = () => { document.title = 'measured' + Array.from(document.images, i => ' ' + "
        "i.src.split('/').pop()"
        " + '=' + (i.clientWidth / i.clientHeight / (i.naturalWidth / i.naturalHeight)).toFixed(3)).join(''); "
        "}</script>";
    for (const char* name : {"setup.html", "details.html"}) {
        std::string html = text_of(read_file(folder.path / name, record_limit));
        html.insert(html.find("</head>"), measure);
        write_file(folder.path / "measured.html", html);
        for (const char* size : {"--window-size=500,900", "--window-size=1600,900"}) {
            const std::string shown = browse(std::string("--dump-dom ") + size, folder.path / "measured.html", folder);
            const std::size_t at = shown.find("<title>measured");
            ASSERT_NE(at, std::string::npos) << shown.substr(0, 2000);
            const std::string title = shown.substr(at, shown.find("</title>", at) - at);
            std::size_t pictures = 0;
            for (std::size_t equal = title.find('='); equal != std::string::npos; equal = title.find('=', equal + 1)) {
                EXPECT_NEAR(std::stod(title.substr(equal + 1)), 1, 0.02) << name << " " << size << ": " << title;
                ++pictures;
            }
            EXPECT_GE(pictures, 2U) << title;
        }
    }
}

TEST(SheetPages, AnOrderHasItsIndexAndAPageForEachJob) {
    if (browser().empty()) GTEST_SKIP() << "skipped: no Chromium here";
    const Folder folder;
    std::vector<SheetOfOrder> sheets;
    const JobInput inputs[] = {tilting_job(), placed_job(), long_job()};
    for (const JobInput& input : inputs)
        sheets.push_back(sheet_of(parse_job(job_file(input), "AB.qjob"), "AB.qjob", "ready"));
    write_file(folder.path / "sheets.html", order_sheets("scan.ply", sheets, {}));
    EXPECT_EQ(pages_of(folder.path / "sheets.html", folder), 4U);
}

}  // namespace
}  // namespace qchopper
