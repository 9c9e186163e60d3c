// The lock of a project, also where the file system refuses to lock: a filter of system calls takes its place.

#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>

#include "app/store/project_folder.h"
#include "base/error.h"
#include "base/process.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// From now on flock() of this process fails with ENOLCK.
bool refuse_locks() {
    std::array<sock_filter, 4> filter{{
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, __NR_flock, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOLCK),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    }};
    const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
    return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

struct ProjectLocks : ::testing::Test {
    fs::path folder = fs::path(testing::TempDir()) / ("locks" + std::to_string(::getpid()));
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }
};

TEST_F(ProjectLocks, OneProgramHoldsItAtATime) {
    const ProjectLock held(folder);
    try {
        const ProjectLock second(folder);
        FAIL() << "two hold the lock";
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::busy) << error.what();
        const std::string holder = first_argument() + ", process " + std::to_string(::getpid()) + " on " + host_name();
        EXPECT_NE(std::string(error.what()).find("by another qchopper: " + holder + ", since 20"), std::string::npos)
            << error.what();
    }
}

TEST_F(ProjectLocks, ItSaysOnlyWhileItIsHeldWhoHoldsIt) {
    { const ProjectLock held(folder); }
    EXPECT_TRUE(fs::is_empty(folder / "lock"));
}

TEST_F(ProjectLocks, AFileSystemWithoutLocksIsNotTakenForABusyProject) {
    const fs::path answer = folder / "answer";
    const pid_t child = ::fork();
    if (child == 0) {
        if (!refuse_locks()) ::_exit(2);
        try {
            const ProjectLock lock(folder);
        } catch (const InputError& error) {
            std::ofstream(answer) << (error.fault == InputFault::create ? "create: " : "another fault: ")
                                  << error.what();
        }
        ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 2) GTEST_SKIP() << "skipped: system calls cannot be filtered here";
    ASSERT_EQ(status, 0);
    std::string said;
    std::getline(std::ifstream(answer), said);
    EXPECT_EQ(said, "create: " + folder.string() + " is on a file system that cannot lock files: No locks available");
}

}  // namespace
}  // namespace qchopper
