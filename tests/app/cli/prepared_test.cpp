// Makes what the other suites read (program.h): ctest runs it before them.

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

TEST(Prepared, IsMadeForAllSuites) {
    const char* const folder = std::getenv("QCHOPPER_PREPARED");
    if (folder == nullptr) GTEST_SKIP() << "QCHOPPER_PREPARED names no folder: each process makes its own";
    fs::remove_all(folder);
    fs::create_directories(folder);
    program::make_prepared(folder);
    EXPECT_TRUE(fs::exists(fs::path(folder) / "scan.qch" / "jobs" / "C.qjob"));
}

}  // namespace
}  // namespace qchopper
