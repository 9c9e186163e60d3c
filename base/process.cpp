// System calls of POSIX. O(1).

#include "base/process.h"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <fstream>
#include <limits>
#include <new>

#include "base/huge_pages.h"

namespace qchopper {

std::string host_name() {
    constexpr std::size_t host_length = 24;
    std::array<char, 256> name{};
    if (::gethostname(name.data(), name.size() - 1) != 0) return "unknown";
    std::string host(name.data());
    host.resize(std::min(host.size(), host_length));
    for (char& c : host) {
        if ((c < '0' || c > '9') && (c < 'A' || c > 'Z') && (c < 'a' || c > 'z')) c = '-';
    }
    return host.empty() ? "unknown" : host;
}

std::string first_argument() {
    std::ifstream file("/proc/self/cmdline", std::ios::binary);
    std::string word;
    std::getline(file, word, '\0');  // the name of the program
    std::getline(file, word, '\0');
    return file ? word : std::string();
}

bool has_process_ended(long process) {
    return ::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH;
}

std::size_t peak_memory() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

void keep_freed_memory() {
#ifdef __GLIBC__
    ::mallopt(M_MMAP_MAX, 0);  // a threshold would end at 32 MB, and maps of large pieces are larger
    ::mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
    // A block that is freed unused becomes the top of the heap, which keeps what is said of its pages. It is smaller
    // than the threshold, and only addresses until it is written to. Where there are not so many, nothing is said.
    constexpr std::size_t size = std::size_t{3} << 29;
    void* block = ::operator new(size, std::nothrow);
    if (block != nullptr) use_huge_pages(block, size);
    ::operator delete(block);
#endif
}

void give_back_freed_memory(std::size_t resident) {
#ifdef __GLIBC__
    std::ifstream file("/proc/self/statm");
    std::size_t whole = 0;
    std::size_t pages = 0;
    if (!(file >> whole >> pages)) return;
    if (pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) > resident) ::malloc_trim(0);
#endif
}

double cpu_seconds() {
    timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace qchopper
