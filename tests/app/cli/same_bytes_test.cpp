// The same scan and settings give the same bytes: twice, elsewhere, on one core or all, and after an interruption.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

#include "app/cli/exit_code.h"
#include "app/store/project_folder.h"
#include "base/files/temporary_name.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using program::Arguments;
using program::Contents;
using program::Ended;
using program::Process;

// All files of a project but its cache: that holds what was evaluated on the way, which may be more after a break.
Contents all_but_cache(const fs::path& project) {
    Contents all = program::contents(project);
    std::erase_if(all, [](const auto& file) { return file.first.starts_with("cache"); });
    return all;
}

// With the path of the scan, the one thing that may differ, taken out of project.json.
Contents project_in(const fs::path& folder) {
    Contents all = all_but_cache(folder / "scan.qch");
    std::string& json = all["project.json"];
    const std::string path = (folder / "scan.ply").string();
    const std::size_t at = json.find(path);
    EXPECT_NE(at, std::string::npos) << path;
    if (at != std::string::npos) json.replace(at, path.size(), "SCAN");
    return all;
}

void expect_same(const Contents& one, const Contents& other) {
    EXPECT_EQ(program::difference(one, other), "");
    EXPECT_TRUE(one.contains("jobs/C.qjob") && one.contains("pieces/C.ply") && one.contains("pictures/exploded.png"));
}

// The name under which a program that has ended wrote a file.
std::string left_by_a_killed_program(const std::string& name) {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const std::string text = temporary_name(name);
        ::_exit(::write(ends[1], text.data(), text.size()) > 0 ? 0 : 1);
    }
    ::close(ends[1]);
    std::string text(256, '\0');
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, ::read(ends[0], text.data(), text.size()))));
    ::close(ends[0]);
    EXPECT_EQ(::waitpid(child, nullptr, 0), child);
    return text;
}

struct SameBytes : ::testing::Test {
    program::Folder folder;
    void SetUp() override { fs::copy(program::prepared() / "scan.ply", folder.path / "scan.ply"); }
    Arguments start() const {
        Arguments arguments = program::prepare_arguments("scan.ply");
        arguments.insert(arguments.end(), {"-o", "scan.qch"});
        return arguments;
    }
    void expect_as_prepared() const { expect_same(project_in(folder.path), project_in(program::prepared())); }
    // Sends a signal after the first cut is reported.
    Ended stopped_after_the_first_cut(const Arguments& arguments, int signal_number) const {
        Process process(arguments, {folder.path});
        EXPECT_TRUE(process.waits_until_err("cut 1 on piece A")) << process.err();
        process.signal(signal_number);
        const Ended ended = process.wait();
        EXPECT_GE(cuts_kept(), 1U);
        return ended;
    }
    void go_on() const {
        const Ended ended = program::run({"prepare", "scan.qch"}, {folder.path});
        EXPECT_EQ(ended.code, 0) << ended.err;
    }
    // The cuts that are kept of a project that was broken off.
    std::size_t cuts_kept() const {
        const Project project = load_project(folder.path / "scan.qch");
        EXPECT_NE(project.stage, Stage::done) << "it was broken off too late for this test";
        return project.cuts.size();
    }
};

TEST_F(SameBytes, ElsewhereAndOnOneCore) {
    const Ended ended = program::run(start(), {folder.path, "", true});
    EXPECT_EQ(ended.code, 0) << ended.err;
    expect_as_prepared();
    EXPECT_FALSE(fs::is_empty(folder.path / "scan.qch" / "cache")) << "nothing is kept of what was evaluated";
}

TEST_F(SameBytes, WithOneThread) {
    Arguments limited = start();
    limited.insert(limited.end(), {"--threads", "1"});
    EXPECT_EQ(program::run(limited, {folder.path}).code, 0);
    expect_as_prepared();
}

TEST_F(SameBytes, WhenItsStagesAreTimed) {
    Arguments timed = start();
    timed.push_back("--timings");
    EXPECT_EQ(program::run(timed, {folder.path}).code, 0);
    expect_as_prepared();
}

TEST_F(SameBytes, FromAFinishedProjectOnceMore) {
    EXPECT_EQ(program::run(start(), {folder.path}).code, 0);
    go_on();
    expect_as_prepared();
}

TEST_F(SameBytes, OfABeamThatIsKilledAfterTheFirstCut) {
    Arguments beam = start();
    beam.insert(beam.end(), {"--beam", "3"});
    ASSERT_EQ(program::run(beam, {folder.path}).code, 0);
    const Contents whole = all_but_cache(folder.path / "scan.qch");
    fs::remove_all(folder.path / "scan.qch");
    EXPECT_EQ(stopped_after_the_first_cut(beam, SIGKILL).killed_by, SIGKILL);
    go_on();
    EXPECT_EQ(program::difference(whole, all_but_cache(folder.path / "scan.qch")), "");
}

TEST_F(SameBytes, KilledAfterTheFirstCut) {
    EXPECT_EQ(stopped_after_the_first_cut(start(), SIGKILL).killed_by, SIGKILL);
    go_on();
    expect_as_prepared();
}

TEST_F(SameBytes, KilledWhileJobsAreWritten) {
    Process process(start(), {folder.path});
    ASSERT_TRUE(process.waits_until_there(folder.path / "scan.qch" / "jobs" / "C.qjob")) << process.err();
    process.signal(SIGKILL);
    EXPECT_EQ(process.wait().killed_by, SIGKILL);
    EXPECT_EQ(cuts_kept(), 2U);
    // What a program that was killed while it wrote leaves behind is cleared away.
    program::put(folder.path / "scan.qch" / "jobs" / left_by_a_killed_program("D.qjob"), "half");
    go_on();
    expect_as_prepared();
}

TEST_F(SameBytes, StoppedByCtrlC) {
    const Ended stopped = stopped_after_the_first_cut(start(), SIGINT);
    EXPECT_EQ(stopped.code, exit_interrupted) << stopped.err;
    EXPECT_NE(stopped.err.find("cuts made so far are kept in scan.qch; go on with: qchopper prepare scan.qch"),
              std::string::npos)
        << stopped.err;
    go_on();
    expect_as_prepared();
}

TEST_F(SameBytes, StoppedByTheSystem) {
    EXPECT_EQ(stopped_after_the_first_cut(start(), SIGTERM).code, exit_terminated);
}

}  // namespace
}  // namespace qchopper
