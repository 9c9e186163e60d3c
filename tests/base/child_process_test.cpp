#include "base/child_process.h"

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <thread>

#include "base/files/temporary_folder.h"

namespace qchopper {
namespace {

using namespace std::chrono_literals;

TEST(ChildProcess, SaysBothOutputsAndItsCode) {
    const ChildOutput said = run_child({"sh", "-c", "echo one; echo two >&2; exit 7"}, 10s);
    EXPECT_EQ(said.code, 7);
    EXPECT_EQ(said.out, "one\n");
    EXPECT_EQ(said.err, "two\n");
}

TEST(ChildProcess, MayBeLongAndGetsNoInput) {
    const ChildOutput said = run_child({"sh", "-c", "cat; seq 1 100000; seq 1 100000 >&2"}, 30s);
    EXPECT_EQ(said.code, 0);
    EXPECT_EQ(said.out, said.err);
    EXPECT_EQ(said.out.size(), 588'895U);
}

TEST(ChildProcess, WordsAreGivenAsTheyAre) {
    EXPECT_EQ(run_child({"printf", "%s|", "a b", "", "$HOME;'"}, 10s).out, "a b||$HOME;'|");
}

TEST(ChildProcess, ThatIsNotThereIs127) {
    EXPECT_EQ(run_child({"no-such-program-of-qchopper"}, 10s).code, 127);
}

TEST(ChildProcess, IsKilledAfterItsTimeWithoutItsOutputsToo) {
    EXPECT_EQ(run_child({"sh", "-c", "exec sleep 60 >&- 2>&-"}, 300ms).code, 128 + SIGKILL);
}

TEST(ChildProcess, IsKilledAfterItsTime) {
    const ChildOutput said = run_child({"sh", "-c", "echo begun; exec sleep 60"}, 300ms);
    EXPECT_EQ(said.code, 128 + SIGKILL);
    EXPECT_EQ(said.out, "begun\n");
}

TEST(Child, RunsBesideThisOneAndAddsToAFile) {
    const TemporaryFolder folder("child-");
    const std::filesystem::path log = folder.path() / "log";
    const auto code_of = [](Child& child) {
        while (!child.code()) std::this_thread::sleep_for(5ms);
        return *child.code();
    };
    Child first({"sh", "-c", "echo one; echo two >&2; exit 3"}, log);
    EXPECT_EQ(code_of(first), 3);
    Child second({"sh", "-c", "echo three; exec sleep 60"}, log);
    EXPECT_FALSE(second.code());
    second.stop();
    EXPECT_EQ(code_of(second), 128 + SIGTERM);
    Child none({"no-such-program-of-qchopper"}, log);
    EXPECT_EQ(code_of(none), 127);
    EXPECT_THROW(Child({"true"}, folder.path() / "none" / "log"), std::system_error);
    std::ifstream file(log);
    std::string text;
    std::getline(file, text, '\0');
    EXPECT_EQ(text.substr(0, 8), "one\ntwo\n");
}

}  // namespace
}  // namespace qchopper
