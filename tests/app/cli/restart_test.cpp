// dispatch --from-chunk: a job that was stopped goes on from a chunk, or nothing moves. The piece is the cap of a ball
// (tests/app/ball_cap.h).

#include <gtest/gtest.h>
#include <signal.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/exit_code.h"
#include "app/store/project_folder.h"
#include "base/files/file.h"
#include "base/files/zip.h"
#include "base/sha256.h"
#include "segment/io/write_mesh.h"
#include "tests/app/ball_cap.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using program::Arguments;
using program::Ended;
using program::Process;

std::string replaced(std::string text, const std::string& old, const std::string& by) {
    const std::size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    return at == std::string::npos ? text : text.replace(at, old.size(), by);
}

bool has(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

// Made once per process: a folder with the proven project LINES.qch of one piece, in program files of so many lines,
// for a controller of so many bytes.
const fs::path& proven(const std::string& lines, const std::string& memory) {
    static std::map<std::string, program::Folder> made;
    const auto known = made.find(lines + memory);
    if (known != made.end()) return known->second.path;
    const fs::path& folder = made[lines + memory].path;
    write_file(folder / "cap.ply", to_ply(ball_cap()));
    std::string cell = program::bytes_in(fs::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
    cell = replaced(cell, "memory_bytes = 3000000", "memory_bytes = " + memory);
    const std::size_t at = cell.find("lines_per_chunk = ");
    program::put(folder / "cell.toml",
                 cell.substr(0, at) + "lines_per_chunk = " + lines + cell.substr(cell.find('\n', at)));
    const Ended ended = program::run({"prepare", "cap.ply", "--units", "mm", "--cell", "cell.toml", "--preset",
                                      "thesis", "--max-cuts", "0", "-o", lines + ".qch"},
                                     {folder});
    EXPECT_EQ(ended.code, 0) << ended.err;
    return folder;
}

struct Restart : ::testing::Test {
    program::Folder folder;
    std::unique_ptr<Process> cell;
    std::string to;

    void SetUp() override {
        fs::create_directory(folder.path / "drop");
        copy("200", "p.qch");
    }
    void copy(const std::string& lines, const std::string& project, const std::string& memory = "3000000") const {
        const fs::path& made = proven(lines, memory);
        fs::copy(made / (lines + ".qch"), folder.path / project, fs::copy_options::recursive);
        fs::copy(made / "cap.ply", folder.path / "cap.ply", fs::copy_options::overwrite_existing);
    }
    fs::path job(const std::string& name) const { return folder.path / "p.qch" / "jobs" / name; }
    Ended run(const Arguments& arguments) const { return program::run(arguments, {folder.path}); }
    Arguments dispatch_of(const std::string& project, const Arguments& more) const {
        Arguments all{"dispatch", project, "--to", to, "--drop", "drop", "--accept-workholding"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    Ended dispatch(const Arguments& more, const std::string& project = "p.qch") const {
        return run(dispatch_of(project, more));
    }
    Ended restart(const std::string& chunk, const std::string& project = "p.qch") const {
        return dispatch({"--piece", "A", "--from-chunk", chunk}, project);
    }
    void start_cell(const std::string& speed, const std::string& consent, const std::string& typed = "") {
        cell = std::make_unique<Process>(Arguments{"cell-sim", "--listen", "127.0.0.1:0", "--drop", "drop", "--speed",
                                                   speed, "--store", "store", "--consent", consent},
                                         program::RunOptions{folder.path, typed});
        to = program::address_of(*cell);
    }
    void stop_cell() {
        cell->signal(SIGTERM);
        EXPECT_EQ(cell->wait().code, 0);
    }
    // Dispatches the job, holds it while it runs, and aborts it.
    void hold_and_abort(const std::string& project = "p.qch") {
        Process first(dispatch_of(project, {}), {folder.path});
        ASSERT_TRUE(first.waits_until_err("the job has started")) << first.err();
        ASSERT_TRUE(first.waits_until_err("in Execute")) << first.err();
        EXPECT_EQ(run({"cell", "hold", "--to", to}).code, 0);
        ASSERT_TRUE(first.waits_until_err("in Held")) << first.err();
        EXPECT_EQ(run({"cell", "abort", "--to", to}).code, 0);
        EXPECT_EQ(first.wait().code, exit_demand_broken) << first.err();
        EXPECT_TRUE(has(first.out(), "aborted")) << first.out();
    }
};

TEST_F(Restart, AJobThatWasHeldAndAbortedEndsAsOneVerifiedPiece) {
    start_cell("20", "ask", "y\ny\ny\ny\ny\ny\n");
    hold_and_abort();
    const program::Contents before = program::contents(folder.path / "p.qch");
    const Ended restarted = dispatch({"--piece", "A", "--from-chunk", "25", "--json"});
    EXPECT_EQ(restarted.code, 0) << restarted.err << restarted.out;
    EXPECT_EQ(program::difference(before, program::contents(folder.path / "p.qch")),
              " +jobs/A.r25.qjob +jobs/A.r25.verdict.json");
    const json document = json::parse(restarted.out);
    EXPECT_EQ(document.at("all_complete"), true);
    EXPECT_EQ(document.at("restart").at("from_chunk"), 25);
    EXPECT_TRUE(document.at("restart").at("chunk_file").get<std::string>().ends_with("_1_025.src"));
    EXPECT_EQ(document.at("restart").at("of_sha256"), to_hex(sha256(read_file(job("A.qjob")))));
    EXPECT_EQ(document.at("jobs").at(0).at("starts"), 1);
    EXPECT_TRUE(has(cell->err(), "A.qjob (piece 1 of 1): is the block loaded")) << cell->err();
    EXPECT_TRUE(has(cell->err(),
                    "A.r25.qjob (piece 1 of 1): have the chunks before it ended, and is it the same "
                    "block, not moved"))
        << cell->err();

    const json whole = json::parse(program::bytes_in(job("A.verdict.json")));
    const json verdict = json::parse(program::bytes_in(job("A.r25.verdict.json")));
    EXPECT_EQ(verdict.at("positive"), true);
    for (std::size_t i = 0; i < whole.at("figures").size(); ++i) {
        const json& figure = whole["figures"][i];
        if (!has("within_tolerance_percent reachable_percent max_leftover_mm leftover_cm3", figure["key"])) continue;
        EXPECT_NEAR(verdict["figures"][i]["value"].get<double>(), figure["value"].get<double>(), 0.0127) << figure;
    }
    const program::Contents after = program::contents(folder.path / "p.qch");
    EXPECT_EQ(run({"verify", "p.qch"}).code, 0) << "the stock is carved once more";
    EXPECT_EQ(program::difference(after, program::contents(folder.path / "p.qch")), "") << "the same verdicts";

    const Ended rest = dispatch({});
    EXPECT_EQ(rest.code, 0) << "the piece is carved";
    EXPECT_TRUE(has(rest.out, "nothing was started: 1 job ended complete")) << rest.out;
    const Ended twice = restart("25");
    EXPECT_EQ(twice.code, exit_use) << twice.out;
    EXPECT_TRUE(has(twice.err, "has carved it to its end")) << twice.err;
    stop_cell();
}

// The computer was switched off while the job ran, and the cell was stopped at its panel.
TEST_F(Restart, AJobThatIsOpenInTheJournalIsAskedForFirst) {
    start_cell("20", "auto");
    {
        Process first(dispatch_of("p.qch", {}), {folder.path});
        ASSERT_TRUE(first.waits_until_err("in Execute")) << first.err();
        first.signal(SIGKILL);
        first.wait();
    }
    EXPECT_EQ(run({"cell", "abort", "--to", to}).code, 0);
    const Ended restarted = restart("26");
    EXPECT_EQ(restarted.code, 0) << restarted.err << restarted.out;
    EXPECT_TRUE(has(restarted.err, "its restart follows")) << restarted.err;
    EXPECT_TRUE(has(restarted.out, "all 1 jobs ended complete")) << restarted.out;
    stop_cell();
}

TEST_F(Restart, APartGoesOnAndThenTheNextOne) {
    copy("150", "parts.qch", "90000");
    const auto chunks = [&](const std::string& name) {
        const Bytes manifest = unzip(read_file(folder.path / "parts.qch" / "jobs" / name), name).at("manifest.json");
        return json::parse(manifest.begin(), manifest.end()).at("programs").at(0).at("chunks");
    };
    ASSERT_TRUE(fs::exists(folder.path / "parts.qch" / "jobs" / "A.p2.qjob"));
    const std::size_t first = chunks("A.qjob").size();
    start_cell("20", "auto");
    hold_and_abort("parts.qch");
    const Ended of_first = restart(std::to_string(first), "parts.qch");
    EXPECT_EQ(of_first.code, 0) << of_first.err << of_first.out;
    hold_and_abort("parts.qch");  // of part 2: that is next
    const Ended before = restart(std::to_string(first), "parts.qch");
    EXPECT_EQ(before.code, exit_use) << "part 1 is carved";
    const std::size_t last = first + chunks("A.p2.qjob").size();
    const Ended of_second = restart(std::to_string(last), "parts.qch");
    EXPECT_EQ(of_second.code, 0) << of_second.err << of_second.out;
    const std::string name = "A.p2.r" + std::to_string(last) + ".qjob";
    EXPECT_TRUE(has(of_second.err, name)) << of_second.err;
    EXPECT_EQ(chunks(name).at(0).at("file"), chunks("A.p2.qjob").back().at("file"));
    EXPECT_EQ(run({"verify", "parts.qch"}).code, 0);
    stop_cell();
}

TEST_F(Restart, AChunkOfAnotherJobIsRefused) {
    start_cell("20", "auto");
    const auto refused = [&](const std::string& chunk, const std::string& project, const std::string& words) {
        const Ended ended = restart(chunk, project);
        EXPECT_EQ(ended.code, exit_use) << ended.out;
        EXPECT_TRUE(has(ended.err, words)) << ended.err;
        EXPECT_TRUE(has(ended.err, "this dispatch started no job")) << ended.err;
        EXPECT_TRUE(has(ended.err, "To do: ")) << ended.err;
    };
    refused("9", "p.qch", "the restart A.r9.qjob is not sent: by the journal the cell has started no job");
    {
        const ProjectLock other(folder.path / "p.qch");
        const Ended busy = restart("9");
        EXPECT_EQ(busy.code, exit_busy) << busy.err;
        EXPECT_TRUE(has(busy.err, "this dispatch started no job")) << busy.err;
    }
    hold_and_abort();
    copy("400", "other.qch");
    refused("4", "other.qch", "the cell was stopped in another job than the one whose chunk this is: A.qjob");
    refused("999", "p.qch", "piece A has no chunk 999: its program has ");
    EXPECT_EQ(restart("1").code, exit_use);
    EXPECT_EQ(dispatch({"--from-chunk", "9"}).code, exit_use) << "of which piece";
    EXPECT_EQ(json::parse(run({"cell", "status", "--to", to, "--json"}).out).dump().find("Execute"), std::string::npos);
    stop_cell();
}

TEST_F(Restart, AChangedCellFileOrStockIsRefused) {
    to = "127.0.0.1:1";  // nothing listens there: what is refused is refused before
    EXPECT_EQ(restart("9").code, exit_unreachable);
    EXPECT_EQ(run({"verify", "p.qch/jobs/A.r9.qjob"}).code, 0);
    const std::string made = program::bytes_in(job("A.r9.qjob"));

    std::map<std::string, Bytes> files = unzip(read_file(job("A.r9.qjob")), "job");
    files.at("stock.bin").back() ^= 1;
    const Bytes damaged = zip(files);
    program::put(job("A.r9.qjob"), {damaged.begin(), damaged.end()});
    const Ended broken = run({"verify", "p.qch/jobs/A.r9.qjob"});
    EXPECT_EQ(broken.code, exit_mesh);
    EXPECT_TRUE(has(broken.err, "A.r9.qjob is not a whole job file: stock.bin does not match its SHA-256"))
        << broken.err;

    // Whole, with the stock of a later chunk.
    EXPECT_EQ(restart("12").code, exit_unreachable);
    const Bytes later = unzip(read_file(job("A.r12.qjob")), "job").at("stock.bin");
    files = unzip({made.begin(), made.end()}, "job");
    const std::string size = "\"size\": ";
    std::string manifest{files.at("manifest.json").begin(), files.at("manifest.json").end()};
    manifest = replaced(manifest, to_hex(sha256(files.at("stock.bin"))), to_hex(sha256(later)));
    manifest =
        replaced(manifest, size + std::to_string(files.at("stock.bin").size()), size + std::to_string(later.size()));
    files.at("stock.bin") = later;
    files.at("manifest.json") = {manifest.begin(), manifest.end()};
    const Bytes other = zip(files);
    program::put(job("A.r9.qjob"), {other.begin(), other.end()});
    for (const Arguments& verify : {Arguments{"verify", "p.qch"}, Arguments{"verify", "p.qch/jobs/A.r9.qjob"}}) {
        const Ended ended = run(verify);
        EXPECT_EQ(ended.code, exit_demand_broken) << ended.err;
        EXPECT_TRUE(has(ended.out, "stock.bin is not what the chunks before qc_") &&
                    has(ended.out, "_1_009.src leave, as A.qjob has them"))
            << ended.out;
    }
    fs::create_directory(folder.path / "alone");
    fs::copy(job("A.r9.qjob"), folder.path / "alone" / "A.r9.qjob");
    const Ended alone = run({"verify", "alone/A.r9.qjob", "--cell", "p.qch/cell.toml"});
    EXPECT_TRUE(has(alone.out, "stock.bin was taken as it is")) << alone.out;
    EXPECT_EQ(restart("9").code, exit_unreachable);
    EXPECT_EQ(program::bytes_in(job("A.r9.qjob")), made) << "made again";

    const fs::path cell_file = folder.path / "p.qch" / "cell.toml";
    program::put(cell_file, program::bytes_in(cell_file) + "# changed\n");
    const Ended changed = restart("9");
    EXPECT_EQ(changed.code, exit_demand_broken);
    EXPECT_TRUE(has(changed.err, "its verdict is that of another cell file; judge it again")) << changed.err;
    EXPECT_TRUE(has(changed.out, "no job was sent")) << changed.out;

    EXPECT_EQ(run({"prepare", "p.qch"}).code, 0);
    EXPECT_FALSE(fs::exists(job("A.r9.qjob"))) << "prepare removes restarts of the jobs that it writes again";
    EXPECT_FALSE(fs::exists(job("A.r9.verdict.json")));
}

}  // namespace
}  // namespace qchopper
