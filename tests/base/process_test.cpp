#include "base/process.h"

#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/resource.h>

#include <cstddef>
#include <fstream>
#include <limits>
#include <vector>

namespace qchopper {
namespace {

long page_faults() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_minflt;
}

std::size_t resident_pages() {
    std::ifstream file("/proc/self/statm");
    std::size_t whole = 0;
    std::size_t resident = 0;
    file >> whole >> resident;
    return resident;
}

// A block of 16 MB is written to and freed, twenty times.
long faults_of_blocks() {
    const long before = page_faults();
    for (int k = 0; k < 20; ++k) {
        const std::vector<char> block(std::size_t{16} << 20, static_cast<char>(k));
        EXPECT_EQ(block.back(), k);
    }
    return page_faults() - before;
}

TEST(Process, FreedMemoryIsKept) {
#if !defined(__GLIBC__) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "memory is not managed by glibc";
#endif
#ifdef __GLIBC__
    ::mallopt(M_MMAP_THRESHOLD, 128 << 10);  // as glibc begins, whatever the environment says
    ::mallopt(M_TRIM_THRESHOLD, 128 << 10);
#endif
    const long given_back = faults_of_blocks();
    keep_freed_memory();
    const long kept = faults_of_blocks();
    EXPECT_GT(given_back, 4 * kept) << kept;
}

TEST(Process, FreedMemoryIsGivenBackWhenItIsAskedFor) {
#if !defined(__GLIBC__) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "memory is not managed by glibc";
#endif
    keep_freed_memory();
    faults_of_blocks();
    const std::size_t kept = resident_pages();
    give_back_freed_memory(std::numeric_limits<std::size_t>::max());
    EXPECT_GT(resident_pages() + 1000, kept) << "so much is not resident";
    give_back_freed_memory(0);
    EXPECT_LT(resident_pages() + 2000, kept) << "of the 4096 of a block";
}

TEST(Process, CpuTimeAndPeakMemoryGrow) {
    const double before = cpu_seconds();
    const std::size_t peak = peak_memory();
    const std::vector<char> block(std::size_t{64} << 20, 'a');
    EXPECT_GE(peak_memory(), peak + (block.size() >> 1));
    EXPECT_GT(cpu_seconds(), before);
}

}  // namespace
}  // namespace qchopper
