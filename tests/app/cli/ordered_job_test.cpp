// Only the job that the project ordered is handed to a cell; anything else is told before anything is sent.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/exit_code.h"
#include "base/files/zip.h"
#include "base/sha256.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using program::bytes_in;
using program::Ended;
using program::Process;
using program::put;

std::string digest(const std::string& bytes) {
    return to_hex(sha256({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}));
}

struct OrderedJob : ::testing::Test {
    program::Folder folder;
    fs::path project = folder.path / "p.qch";
    fs::path job = project / "jobs" / "C.qjob";
    std::unique_ptr<Process> cell;
    std::string to;

    void SetUp() override {
        restore();
        fs::create_directory(folder.path / "drop");
        cell = std::make_unique<Process>(
            program::Arguments{"cell-sim", "--listen", "127.0.0.1:0", "--drop", "drop", "--speed", "100000"},
            program::RunOptions{folder.path});
        ASSERT_TRUE(cell->waits_until_out("\n")) << cell->err();
        to = cell->out().substr(10, cell->out().find('\n') - 10);
    }
    void TearDown() override {
        cell->signal(SIGTERM);
        EXPECT_EQ(cell->wait().code, 0);
    }
    void restore() const {
        fs::remove_all(project);
        fs::copy(program::prepared() / "scan.qch", project, fs::copy_options::recursive);
    }
    void change(const fs::path& file, const std::string& from, const std::string& with) const {
        std::string text = bytes_in(file);
        ASSERT_NE(text.find(from), std::string::npos) << from;
        put(file, text.replace(text.find(from), from.size(), with));
    }
    // A whole job file, forged by somebody who knows the format; the record in project.json is made to agree if told.
    void forge(const std::function<void(std::map<std::string, Bytes>&, Json&)>& what, bool with_record) const {
        const std::string old = bytes_in(job);
        std::map<std::string, Bytes> files = unzip({old.begin(), old.end()}, "C.qjob");
        const Bytes& manifest_bytes = files.at("manifest.json");
        Json manifest = Json::parse(manifest_bytes.begin(), manifest_bytes.end());
        what(files, manifest);
        for (Json& entry : manifest["files"]) {
            const Bytes& bytes = files.at(entry["name"].get<std::string>());
            entry["size"] = bytes.size();
            entry["sha256"] = to_hex(sha256(bytes));
        }
        const std::string text = manifest.dump(2) + "\n";
        files["manifest.json"] = {text.begin(), text.end()};
        const Bytes made = zip(files);
        put(job, {made.begin(), made.end()});
        if (with_record) change(project / "project.json", digest(old), digest(bytes_in(job)));
    }
    // By dispatch as by dry-run, in one line that says these words, and the cell hears nothing of it.
    void expect_refused(int code, const std::string& words) const {
        const program::Arguments dispatch{"dispatch", "p.qch", "--to", to, "--drop", "drop"};
        for (const program::Arguments& arguments : {dispatch, program::Arguments{"dry-run", "p.qch"}}) {
            const Ended ended = program::run(arguments, {folder.path});
            EXPECT_EQ(ended.code, code) << ended.err << ended.out;
            EXPECT_NE(ended.err.find(words), std::string::npos) << words << "\n" << ended.err;
            EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
        }
        EXPECT_EQ(cell->err().find("CLAIM"), std::string::npos) << cell->err();
    }
};

TEST_F(OrderedJob, AJobOfAnotherPieceOrProjectOrCellIsRefused) {
    for (const auto& entry : fs::directory_iterator(project / "jobs")) {
        if (entry.path() != job) fs::copy_file(job, entry.path(), fs::copy_options::overwrite_existing);
    }
    expect_refused(exit_mesh, "is the job of piece C, not of piece");

    restore();
    const auto elsewhere = [](std::map<std::string, Bytes>& files, Json& manifest) {
        manifest["project_id"] = std::string(32, '7');
        Json ticket = Json::parse(files.at("ticket.json").begin(), files.at("ticket.json").end());
        ticket["project_id"] = std::string(32, '7');
        const std::string text = ticket.dump(2) + "\n";
        files["ticket.json"] = {text.begin(), text.end()};
    };
    forge(elsewhere, true);
    expect_refused(exit_mesh, "C.qjob is a job of another project, or of other cuts");
    Json record = Json::parse(bytes_in(project / "project.json"));
    for (Json& written : record["jobs"]) written["project_id"] = std::string(32, '7');
    put(project / "project.json", record.dump(1) + "\n");
    expect_refused(exit_mesh, "is a job of another project, or of other cuts");

    restore();
    change(project / "cell.toml", "id = 1", "id = 2");
    expect_refused(exit_mesh, "is made for cell 1, and the cell here is 2");
}

TEST_F(OrderedJob, AJobThatDoesNotFitOrWasChangedIsRefused) {
    const auto misfit = [](std::map<std::string, Bytes>&, Json& manifest) {
        manifest["stock_fit"]["fits"] = false;
        manifest["stock_fit"]["margins"][0]["mm"] = -1.5;
    };
    forge(misfit, true);
    expect_refused(exit_mesh, "C.qjob states that its piece does not fit the cell");

    restore();
    forge([](std::map<std::string, Bytes>& files, Json&) { files.at("piece.stl").at(200) ^= 1; }, false);
    expect_refused(exit_mesh, "C.qjob is not the file that prepare wrote");

    restore();
    put(job, bytes_in(job) + "x");
    expect_refused(exit_mesh, "C.qjob is not a whole job file");

    restore();
    fs::remove(job);
    expect_refused(exit_missing, "C.qjob is gone");
}

TEST_F(OrderedJob, WithoutARecordNothingIsSentAndPrepareMakesOne) {
    Json without = Json::parse(bytes_in(project / "project.json"));
    without["jobs"] = Json::array();
    put(project / "project.json", without.dump(1) + "\n");
    expect_refused(exit_mesh, "keeps no record of");
    const Ended prepared = program::run({"prepare", "p.qch"}, {folder.path});
    EXPECT_EQ(prepared.code, 0) << prepared.err;
    EXPECT_EQ(bytes_in(project / "project.json"), bytes_in(program::prepared() / "scan.qch" / "project.json"));
    EXPECT_EQ(program::run({"dry-run", "p.qch", "--piece", "C"}, {folder.path}).code, 0);
}

// All jobs are checked before the first is sent, so that of piece C, the last, stops those before it too.
TEST_F(OrderedJob, AnUnreachableJobIsSentOnlyWhenThatIsAccepted) {
    const auto unreachable = [](std::map<std::string, Bytes>&, Json& manifest) {
        Json& reach = manifest["setup"]["reach"];
        reach["area_mm2"] = 1000.0;
        reach["hidden_mm2"] = 52.0;
        reach["steep_mm2"] = reach["holder_mm2"] = reach["too_narrow_mm2"] = 0.0;
        reach["unreachable_share"] = 0.052;
        manifest["max_unreachable"] = 0.02;
        manifest["state"] = "unreachable";
    };
    forge(unreachable, true);
    const std::string words = "piece C: the tool does not reach 5.20 % of its surface, and the limit is 2.00 %";
    program::Arguments dispatch{"dispatch", "p.qch", "--to", to, "--drop", "drop"};
    const Ended refused = program::run(dispatch, {folder.path});
    EXPECT_EQ(refused.code, exit_demand_broken) << refused.err;
    EXPECT_NE(refused.err.find(words + "; pass --accept-unreachable"), std::string::npos) << refused.err;
    EXPECT_EQ(refused.out, "no job was sent\n");
    EXPECT_EQ(cell->err().find("CLAIM"), std::string::npos) << cell->err();

    dispatch.push_back("--json");
    const Json document = Json::parse(program::run(dispatch, {folder.path}).out);
    EXPECT_EQ(document["schema"], "qchopper-dispatch-2");
    EXPECT_EQ(document["all_complete"], false);
    EXPECT_EQ(document["jobs"].size(), 0U);
    EXPECT_EQ(document["refused"].size(), 1U);

    const Ended dry = program::run({"dry-run", "p.qch", "--piece", "C"}, {folder.path});
    EXPECT_EQ(dry.code, 0) << dry.err;
    EXPECT_NE(dry.err.find("warning: " + words), std::string::npos) << dry.err;

    dispatch.back() = "--accept-unreachable";
    const Ended accepted = program::run(dispatch, {folder.path});
    EXPECT_EQ(accepted.code, 0) << accepted.err;
    EXPECT_NE(accepted.out.find("all 3 jobs ended complete"), std::string::npos) << accepted.out;
}

// On a terminal it asks, elsewhere it refuses without the option.
TEST_F(OrderedJob, AJobWhosePieceIsNotHeldIsSentOnlyWhenThatIsAccepted) {
    const auto unheld = [](std::map<std::string, Bytes>&, Json& manifest) {
        manifest["setup"]["workholding"] = {
            {"cutting_force_n", 20.0}, {"joint_strength", 0.1}, {"max_slenderness", 4.0}, {"bending_strength", 0.6},
            {"height", 214.0},         {"base_mm2", 460.0},     {"base_width", 24.2},     {"joint_force_n", 3.8},
            {"foam_force_n", 3.9},     {"narrowest_z", 0.0},    {"narrowest_mm2", 460.0}, {"passes", false},
            {"stand", nullptr}};
    };
    forge(unheld, true);
    const std::string words =
        "piece C is not held safely: tape or glue of 0.1 N/mm2 parts at 3.8 N, less than the cutting force of 20 N";
    program::Arguments dispatch{"dispatch", "p.qch", "--to", to, "--drop", "drop"};
    const Ended refused = program::run(dispatch, {folder.path});
    EXPECT_EQ(refused.code, exit_demand_broken) << refused.err;
    EXPECT_NE(refused.err.find(words), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("pass --accept-workholding"), std::string::npos) << refused.err;
    EXPECT_EQ(refused.out, "no job was sent\n");
    EXPECT_EQ(cell->err().find("CLAIM"), std::string::npos) << cell->err();

    const Ended dry = program::run({"dry-run", "p.qch", "--piece", "C"}, {folder.path});
    EXPECT_EQ(dry.code, 0) << dry.err;
    EXPECT_NE(dry.err.find("warning: " + words), std::string::npos) << dry.err;

    program::RunOptions terminal{folder.path, "n\n"};
    terminal.has_terminal = true;
    const Ended declined = program::run(dispatch, terminal);
    EXPECT_EQ(declined.code, exit_demand_broken) << declined.err;
    EXPECT_NE(declined.err.find("[y/N]"), std::string::npos) << declined.err;
    EXPECT_EQ(cell->err().find("CLAIM"), std::string::npos) << cell->err();
    terminal.input = "y\n";
    const Ended agreed = program::run(dispatch, terminal);
    EXPECT_EQ(agreed.code, 0) << agreed.err;
    EXPECT_NE(agreed.err.find(words), std::string::npos) << agreed.err;

    dispatch.insert(dispatch.end(), {"--again", "--accept-workholding"});
    const Ended accepted = program::run(dispatch, {folder.path});
    EXPECT_EQ(accepted.code, 0) << accepted.err;
    EXPECT_NE(accepted.out.find("all 3 jobs ended complete"), std::string::npos) << accepted.out;
}

// A pipe without a writer never gives a byte, a device has no end.
TEST_F(OrderedJob, OnlyRegularFilesAreRead) {
    for (const fs::path& file : {job, project / "project.json", project / "cell.toml"}) {
        fs::remove(file);
        ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
        expect_refused(exit_missing, file.filename().string() + " is a pipe, not a file");
        fs::remove(file);
        fs::create_symlink("/dev/zero", file);
        expect_refused(exit_missing, file.filename().string() + " is a device, not a file");
        restore();
    }
    fs::resize_file(job, std::uintmax_t{1} << 40);
    expect_refused(exit_mesh, "larger than 4 GB");
}

TEST_F(OrderedJob, AFolderThatAKilledDryRunLeftIsRemovedByTheNext) {
    const fs::path temporary = folder.path / "tmp";
    fs::create_directory(temporary);
    program::RunOptions around{folder.path};
    around.temporary_folder = temporary;
    Process slow({"dry-run", "p.qch", "--speed", "1"}, around);
    ASSERT_TRUE(slow.waits_until_err("dry run: a simulated cell")) << slow.err();
    slow.signal(SIGKILL);
    EXPECT_EQ(slow.wait().killed_by, SIGKILL);
    EXPECT_FALSE(fs::is_empty(temporary));
    EXPECT_EQ(program::run({"dry-run", "p.qch", "--piece", "C"}, around).code, 0);
    EXPECT_TRUE(fs::is_empty(temporary));
}

TEST_F(OrderedJob, UndoingADecisionDropsTheRecords) {
    EXPECT_EQ(Json::parse(bytes_in(project / "project.json"))["jobs"].size(), 3U);
    const Ended undone = program::run({"segment", "p.qch", "--undo"}, {folder.path});
    EXPECT_EQ(undone.code, 0) << undone.err;
    EXPECT_EQ(Json::parse(bytes_in(project / "project.json"))["jobs"].size(), 0U);
}

}  // namespace
}  // namespace qchopper
