// A piece whose program exceeds the controller's memory: jobs in parts, each proven from what the one before left.

#include <gtest/gtest.h>

#include <mutex>
#include <nlohmann/json.hpp>

#include "app/dispatch/dispatch_jobs.h"
#include "base/error.h"
#include "base/files/zip.h"
#include "base/hex.h"
#include "base/sha256.h"
#include "devices/wire/modbus_tcp.h"
#include "sim/cell/cell_sim.h"
#include "sim/replay/stock/stock_record.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string replaced(std::string text, const std::string& old, const std::string& by) {
    const std::size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    return at == std::string::npos ? text : text.replace(at, old.size(), by);
}

struct Parts : ::testing::Test {
    program::Folder folder;
    program::Ended run(const program::Arguments& arguments) const { return program::run(arguments, {folder.path}); }

    // A small vertebra for a controller of so many bytes: made once, then copied.
    void prepare(const std::string& memory, const std::string& project) const {
        static std::map<std::string, program::Folder> made;
        const auto [it, is_new] = made.try_emplace(memory);
        if (is_new) make(it->second.path, memory);
        fs::copy(it->second.path / "cell.toml", folder.path, fs::copy_options::overwrite_existing);
        fs::copy(it->second.path / "made.qch", folder.path / project, fs::copy_options::recursive);
    }
    static void make(const fs::path& where, const std::string& memory) {
        const program::RunOptions here{where};
        ASSERT_EQ(program::run({"sample", "vertebra", "--faces", "2000", "-o", "v.ply"}, here).code, 0);
        const std::string cell = program::bytes_in(fs::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
        program::put(where / "cell.toml", replaced(cell, "memory_bytes = 3000000", "memory_bytes = " + memory));
        const program::Arguments prepare{"prepare", "v.ply",     "--units",    "mm", "--scale", "0.15",
                                         "--cell",  "cell.toml", "--min-cuts", "0",  "-o",      "made.qch"};
        const program::Ended ended = program::run(prepare, here);
        ASSERT_LE(ended.code, 1) << ended.err;  // 1: the piece is not proven, its jobs are there
    }
    fs::path job(const std::string& name) const { return folder.path / "p.qch" / "jobs" / name; }
    json verdict(const std::string& project, const std::string& name) const {
        return json::parse(program::bytes_in(folder.path / project / "jobs" / (name + ".verdict.json")));
    }
    std::vector<std::string> kinds(const std::string& name) const {
        std::vector<std::string> kinds;
        const json whole = verdict("p.qch", name);
        for (const json& finding : whole["findings"]) kinds.push_back(finding["kind"]);
        return kinds;
    }
};

std::map<std::string, double> figures(const json& verdict) {
    std::map<std::string, double> values;
    for (const json& figure : verdict["figures"]) values[figure["key"]] = figure["value"];
    return values;
}

// A job whose stock.bin names another tool, whole but for that, and the project's record of it.
void change_stock(const fs::path& job, const fs::path& project) {
    const std::string old = program::bytes_in(job);
    std::map<std::string, Bytes> files = unzip({old.begin(), old.end()}, "job");
    StockRecord stock = read_stock(files.at("stock.bin"), "stock.bin");
    ++stock.tools.back().tool;
    const Bytes changed = to_bytes(stock);
    const Bytes& manifest = files.at("manifest.json");
    const std::string listed =
        replaced({manifest.begin(), manifest.end()}, to_hex(sha256(files.at("stock.bin"))), to_hex(sha256(changed)));
    ASSERT_EQ(changed.size(), files.at("stock.bin").size());
    files["stock.bin"] = changed;
    files["manifest.json"] = {listed.begin(), listed.end()};
    const Bytes written = zip(files);
    program::put(job, {written.begin(), written.end()});
    program::put(project, replaced(program::bytes_in(project), to_hex(sha256(Bytes{old.begin(), old.end()})),
                                   to_hex(sha256(written))));
}

TEST_F(Parts, TheLastOneHasTheFiguresOfTheUndividedProgram) {
    prepare("3000000", "whole.qch");
    ASSERT_FALSE(fs::exists(folder.path / "whole.qch" / "jobs" / "A.p2.qjob"));
    std::map<std::string, double> whole = figures(verdict("whole.qch", "A"));
    prepare("240000", "two.qch");
    ASSERT_FALSE(fs::exists(folder.path / "two.qch" / "jobs" / "A.p3.qjob"));
    prepare("150000", "three.qch");
    ASSERT_TRUE(fs::exists(folder.path / "three.qch" / "jobs" / "A.p3.qjob"));
    ASSERT_FALSE(fs::exists(folder.path / "three.qch" / "jobs" / "A.p4.qjob"));
    for (const auto& [project, name] :
         std::vector<std::pair<std::string, std::string>>{{"two.qch", "A.p2"}, {"three.qch", "A.p3"}}) {
        std::map<std::string, double> last = figures(verdict(project, name));
        EXPECT_NEAR(last["within_tolerance_percent"], whole["within_tolerance_percent"], 0.2) << name;
        EXPECT_NEAR(last["reachable_percent"], whole["reachable_percent"], 1e-9) << name;
        EXPECT_NEAR(last["max_leftover_mm"], whole["max_leftover_mm"], 0.25) << name;
        EXPECT_NEAR(last["leftover_cm3"], whole["leftover_cm3"], 0.02 * whole["leftover_cm3"]) << name;
        EXPECT_EQ(last["rapids_in_foam"], 0) << name;
        EXPECT_FALSE(figures(verdict(project, "A")).contains("reachable_percent")) << "of the first part";
        EXPECT_EQ(verdict(project, "A")["findings"].size(), 0U);
    }
}

TEST_F(Parts, AreVerifiedInTheirOrder) {
    prepare("150000", "p.qch");
    const program::Contents before = program::contents(folder.path);
    run({"verify", "p.qch"});
    EXPECT_EQ(program::difference(before, program::contents(folder.path)), "") << "the same verdicts";
    EXPECT_EQ(run({"verify", "p.qch/jobs/A.p2.qjob"}).code, 0) << "by the stock that it carries";

    // Swapped, and missing.
    const std::string second = program::bytes_in(job("A.p2.qjob"));
    program::put(job("A.p2.qjob"), program::bytes_in(job("A.p3.qjob")));
    EXPECT_NE(run({"verify", "p.qch"}).code, 0);
    fs::remove(job("A.p2.qjob"));
    EXPECT_NE(run({"verify", "p.qch"}).code, 0);
    program::put(job("A.p2.qjob"), second);

    change_stock(job("A.p2.qjob"), folder.path / "p.qch" / "project.json");
    const program::Ended changed = run({"verify", "p.qch"});
    EXPECT_NE(changed.code, 0);
    EXPECT_TRUE(kinds("A").empty());
    ASSERT_FALSE(kinds("A.p2").empty()) << changed.out << changed.err;
    EXPECT_EQ(kinds("A.p2").front(), "other_stock");
    ASSERT_FALSE(kinds("A.p3").empty());
    EXPECT_EQ(kinds("A.p3").front(), "other_part") << "it names another file as part 2";
}

// A simulated cell with a journal, and an operator who answers each question.
class Attended {
 public:
    explicit Attended(const fs::path& folder) : folder_(folder) {
        fs::create_directories(folder_ / "drop");
        CellSimOptions options;
        options.drop_folder = folder_ / "drop";
        options.limits.speed = 1e6;
        options.limits.acting_ms = 20;
        options.limits.consent = Consent::ask;
        options.ask = [this](const std::string& question) {
            const std::lock_guard lock(asking_);
            questions_.push_back(question);
            return refuses_.empty() || question.find(refuses_) == std::string::npos;
        };
        cell_ = std::make_unique<CellSim>(options);
        cell_->start();
    }
    std::vector<DispatchedJob> dispatch_jobs(const std::vector<PieceJob>& jobs) const {
        Journal journal(folder_ / "journal", {any_cell_id, true, "parts"});
        ModbusTcpBus bus({"127.0.0.1", cell_->port()});
        DispatchOptions options;
        options.drop_folder = folder_ / "drop";
        options.timings.poll_s = 0.01;
        return qchopper::dispatch_jobs(jobs, bus, options, journal, {});
    }
    void refuse(const std::string& words) {
        const std::lock_guard lock(asking_);
        refuses_ = words;
    }
    std::vector<std::string> questions() {
        const std::lock_guard lock(asking_);
        return questions_;
    }
    std::uint32_t starts_total() const { return cell_->status().starts_total; }

 private:
    fs::path folder_;
    std::mutex asking_;
    std::vector<std::string> questions_;
    std::string refuses_;
    std::unique_ptr<CellSim> cell_;
};

TEST_F(Parts, AreHandedOverInTheirOrderEachAfterTheOneBeforeAndToTheSameBlock) {
    prepare("150000", "p.qch");
    const std::vector<PieceJob> jobs = jobs_of(folder.path / "p.qch", std::nullopt, {}).jobs;
    ASSERT_EQ(jobs.size(), 3U);
    for (std::uint16_t k = 1; k <= 3; ++k) {
        EXPECT_EQ(jobs[k - 1U].part, k);
        EXPECT_EQ(jobs[k - 1U].parts, 3);
        EXPECT_EQ(jobs[k - 1U].ticket.about.part, k) << "and in the ticket";
        EXPECT_EQ(jobs[k - 1U].ticket.about.parts, 3);
    }
    Attended cell(folder.path);
    EXPECT_THROW(cell.dispatch_jobs({jobs[1]}), InputError) << "part 1 has not ended";
    cell.refuse("part 2 of 3");
    EXPECT_EQ(cell.dispatch_jobs(jobs).size(), 2U) << "part 3 is not tried";
    EXPECT_EQ(cell.starts_total(), 1U);
    EXPECT_THROW(cell.dispatch_jobs({jobs[2]}), InputError) << "part 2 has not ended";
    cell.refuse("");
    const std::vector<DispatchedJob> rest = cell.dispatch_jobs(jobs);
    ASSERT_EQ(rest.size(), 3U);
    EXPECT_TRUE(rest[0].outcome.milled_complete);
    EXPECT_TRUE(rest[1].outcome.is_complete() && rest[2].outcome.is_complete()) << rest[2].outcome.why;
    EXPECT_EQ(cell.starts_total(), 3U);
    const std::vector<std::string> questions = cell.questions();
    const std::string expected[] = {"part 1 of 3): is the block loaded",
                                    "part 2 of 3): is it the same block, not moved since part 1",
                                    "part 2 of 3): is it the same block, not moved since part 1",
                                    "part 3 of 3): is it the same block, not moved since part 2"};
    ASSERT_EQ(questions.size(), std::size(expected));
    for (std::size_t i = 0; i < questions.size(); ++i) {
        EXPECT_NE(questions[i].find(expected[i]), std::string::npos) << questions[i];
    }
}

}  // namespace
}  // namespace qchopper
