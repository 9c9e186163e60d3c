#include "segment/files/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "segment/error.h"
#include "segment/files/huge_pages.h"

namespace qchopper {
namespace {

// Closes a descriptor on every way out.
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
    const std::filesystem::path aside = path.string() + ".tmp." + std::to_string(::getpid());
    try {
        const Descriptor file(::open(aside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
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

}  // namespace

Bytes read_file(const std::filesystem::path& path) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.fd < 0) {
        throw InputError(InputFault::missing, path.string() + " cannot be opened: " + reason(),
                         "check the name and the rights");
    }
    struct stat info {};
    if (::fstat(file.fd, &info) == 0 && S_ISDIR(info.st_mode)) {
        throw InputError(InputFault::missing, path.string() + " is a folder, not a file", "name the file itself");
    }
    const std::size_t room = static_cast<std::size_t>(info.st_size > 0 ? info.st_size : 0) + 1;  // to see the end
    Bytes bytes;
    reserve_huge(bytes, room);
    bytes.resize(room);
    std::size_t filled = 0;
    while (true) {
        if (filled == bytes.size()) bytes.resize(filled + 65536);  // a pipe has no size
        const ssize_t got = ::read(file.fd, bytes.data() + filled, bytes.size() - filled);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw InputError(InputFault::missing, path.string() + " cannot be read: " + reason());
        if (got == 0) break;
        filled += static_cast<std::size_t>(got);
    }
    bytes.resize(filled);
    return bytes;
}

void write_file(const std::filesystem::path& path, const Bytes& bytes) {
    write_bytes(path, bytes.data(), bytes.size());
}

void write_file(const std::filesystem::path& path, std::string_view text) {
    write_bytes(path, reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

}  // namespace qchopper
