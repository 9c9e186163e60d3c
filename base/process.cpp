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
    constexpr int largest = 32 << 20;  // the most that glibc takes
    ::mallopt(M_MMAP_THRESHOLD, largest);
    ::mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

double cpu_seconds() {
    timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace qchopper
