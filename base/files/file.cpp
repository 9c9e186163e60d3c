// Plain POSIX calls, repeated where a signal interrupts them. A file of n bytes is read into n + 1 bytes of memory.

#include "base/files/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "base/error.h"
#include "base/files/temporary_name.h"
#include "base/files/unfinished.h"
#include "base/huge_pages.h"

namespace qchopper {
namespace {

// Closes its descriptor at the end of the scope, also after an exception.
struct Descriptor {
    int fd;
    explicit Descriptor(int descriptor) : fd(descriptor) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (fd >= 0) ::close(fd);
    }
};

std::string reason() {
    return std::generic_category().message(errno);
}

void write_all(int fd, const std::uint8_t* data, std::size_t size, const std::filesystem::path& path) {
    while (size > 0) {
        const ssize_t written = ::write(fd, data, size);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) throw InputError(InputFault::io, path.string() + " cannot be written: " + reason());
        data += written;
        size -= static_cast<std::size_t>(written);
    }
}

void write_bytes(const std::filesystem::path& path, const std::uint8_t* data, std::size_t size) {
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    const std::filesystem::path aside = path.parent_path() / temporary_name(path.filename().string());
    const Unfinished listed(aside);
    try {
        const Descriptor file(::open(aside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
        if (file.fd < 0) throw InputError(InputFault::create, path.string() + " cannot be created: " + reason());
        write_all(file.fd, data, size, path);
        if (::fsync(file.fd) != 0) throw InputError(InputFault::io, path.string() + " cannot be saved: " + reason());
        if (::rename(aside.c_str(), path.c_str()) != 0) {
            throw InputError(InputFault::create, path.string() + " cannot be replaced: " + reason());
        }
    } catch (...) {
        ::unlink(aside.c_str());
        throw;
    }
    const Descriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (directory.fd >= 0) ::fsync(directory.fd);
}

const char* kind_of(mode_t mode) {
    if (S_ISDIR(mode)) return "a folder";
    if (S_ISFIFO(mode)) return "a pipe";
    if (S_ISSOCK(mode)) return "a socket";
    return "a device";
}

void refuse_irregular(const std::filesystem::path& path, mode_t mode) {
    if (S_ISREG(mode)) return;
    throw InputError(InputFault::missing, path.string() + " is " + kind_of(mode) + ", not a file",
                     "name the file itself");
}

std::string describe(std::uint64_t bytes) {
    const bool is_large = bytes + 1 >= std::uint64_t{1} << 30;
    return std::to_string((bytes + 1) >> (is_large ? 30U : 20U)) + (is_large ? " GB" : " MB");
}

[[noreturn]] void refuse_size(const std::string& name, SizeLimit limit) {
    throw InputError(limit.fault, name + " is larger than " + describe(limit.bytes) + ", the most that such a file has",
                     "check that it is the right file");
}

// `size` is what is expected; the file may have more or fewer bytes by now.
Bytes read_to_end(int fd, std::uint64_t size, const std::string& name, SizeLimit limit) {
    Bytes bytes;
    const std::size_t capacity = static_cast<std::size_t>(size) + 1;  // one more, so that the end is read as well
    reserve_huge(bytes, capacity);
    bytes.resize(capacity);
    std::size_t filled = 0;
    while (true) {
        if (filled > limit.bytes) refuse_size(name, limit);
        if (filled == bytes.size()) bytes.resize(filled + 65536);
        const ssize_t got = ::read(fd, bytes.data() + filled, bytes.size() - filled);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw InputError(InputFault::missing, name + " cannot be read: " + reason());
        if (got == 0) break;
        filled += static_cast<std::size_t>(got);
    }
    bytes.resize(filled);
    return bytes;
}

}  // namespace

Bytes read_file(const std::filesystem::path& path, SizeLimit limit) {
    // Without O_NONBLOCK the opening of a named pipe waits for a writer; for regular files it makes no difference.
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
    if (file.fd < 0) {
        throw InputError(InputFault::missing, path.string() + " cannot be opened: " + reason(),
                         "check the name and the rights");
    }
    struct stat info {};
    if (::fstat(file.fd, &info) != 0) {
        throw InputError(InputFault::missing, path.string() + " cannot be read: " + reason());
    }
    refuse_irregular(path, info.st_mode);
    const auto size = static_cast<std::uint64_t>(info.st_size);
    if (size > limit.bytes) refuse_size(path.string(), limit);
    return read_to_end(file.fd, size, path.string(), limit);
}

void check_regular_file(const std::filesystem::path& path) {
    struct stat info {};
    if (::stat(path.c_str(), &info) == 0) refuse_irregular(path, info.st_mode);
}

Bytes read_standard_input(SizeLimit limit) {
    return read_to_end(STDIN_FILENO, 0, "standard input", limit);
}

void write_file(const std::filesystem::path& path, const Bytes& bytes) {
    write_bytes(path, bytes.data(), bytes.size());
}

void write_file(const std::filesystem::path& path, std::string_view text) {
    write_bytes(path, reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

}  // namespace qchopper
