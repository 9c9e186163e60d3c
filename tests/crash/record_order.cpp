// A shared library for LD_PRELOAD: writes one line per call of write, fsync, rename and send into the file ORDER_LOG,
// in the order of the calls, for the files of a journal and for job files. For sync_order_test.cpp.
//
//   wrote PATH    synced PATH    renamed PATH    sent HEX

#include <dlfcn.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

template <class Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

void note(const std::string& line) {
    static std::FILE* log = [] {
        const char* path = std::getenv("ORDER_LOG");
        return path == nullptr ? nullptr : std::fopen(path, "ae");
    }();
    if (log == nullptr) return;
    std::fputs((line + "\n").c_str(), log);
    std::fflush(log);
}

std::string path_of(int descriptor) {
    char path[512];
    const ssize_t length = readlink(("/proc/self/fd/" + std::to_string(descriptor)).c_str(), path, sizeof path);
    return length > 0 ? std::string(path, static_cast<std::size_t>(length)) : std::string("?");
}

bool is_noted(const std::string& path) {
    return path.find("journal.sqlite") != std::string::npos || path.find(".qjob") != std::string::npos;
}

void note_write(int descriptor) {
    const std::string path = path_of(descriptor);
    if (is_noted(path)) note("wrote " + path);
}

void note_sync(int descriptor) {
    const std::string path = path_of(descriptor);
    if (is_noted(path)) note("synced " + path);
}

}  // namespace

extern "C" {

ssize_t pwrite64(int fd, const void* data, size_t size, off64_t at) {
    note_write(fd);
    static const auto real = next<ssize_t (*)(int, const void*, size_t, off64_t)>("pwrite64");
    return real(fd, data, size, at);
}

ssize_t pwrite(int fd, const void* data, size_t size, off_t at) {
    note_write(fd);
    static const auto real = next<ssize_t (*)(int, const void*, size_t, off_t)>("pwrite");
    return real(fd, data, size, at);
}

int fsync(int fd) {
    note_sync(fd);
    static const auto real = next<int (*)(int)>("fsync");
    return real(fd);
}

int fdatasync(int fd) {
    note_sync(fd);
    static const auto real = next<int (*)(int)>("fdatasync");
    return real(fd);
}

int rename(const char* from, const char* to) {
    if (is_noted(from)) note(std::string("renamed ") + from);
    static const auto real = next<int (*)(const char*, const char*)>("rename");
    return real(from, to);
}

ssize_t send(int fd, const void* data, size_t size, int flags) {
    constexpr size_t most = 27;  // the header and the registers of COMMAND up to CMD
    std::string hex;
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (size_t i = 0; i < size && i < most; ++i) {
        char digits[3];
        std::snprintf(digits, sizeof digits, "%02x", bytes[i]);
        hex += digits;
    }
    note("sent " + hex);
    static const auto real = next<ssize_t (*)(int, const void*, size_t, int)>("send");
    return real(fd, data, size, flags);
}
}
