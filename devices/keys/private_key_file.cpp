// One open() without following links, and all checks on that descriptor. O(1), beside scrypt (devices/wire/ed25519.h).

#include "devices/keys/private_key_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "base/error.h"
#include "base/files/temporary_name.h"
#include "base/files/unfinished.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_bytes = 16384;  // a key has about 500
constexpr mode_t others = S_IRWXG | S_IRWXO;

class OpenedFile {
 public:
    explicit OpenedFile(int fd) : fd_(fd) {}
    ~OpenedFile() {
        if (fd_ >= 0) ::close(fd_);
    }
    OpenedFile(const OpenedFile&) = delete;
    OpenedFile& operator=(const OpenedFile&) = delete;
    int get() const { return fd_; }

 private:
    int fd_;
};

std::string reason() {
    return std::strerror(errno);
}

[[noreturn]] void refuse(const fs::path& path, const std::string& why, const std::string& to_do) {
    throw InputError(InputFault::config, "the private key " + path.string() + " is not used: " + why, to_do);
}

constexpr const char* restore = "restore the file from a copy, or make another key and have it trusted";

void write_whole(int fd, const fs::path& path, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = ::write(fd, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) throw InputError(InputFault::io, path.string() + " cannot be written: " + reason());
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    if (::fsync(fd) != 0) throw InputError(InputFault::io, path.string() + " cannot be written: " + reason());
}

// Removes the temporary name at the end, whatever happens.
class TemporaryName {
 public:
    explicit TemporaryName(fs::path path) : path_(std::move(path)), listed_(path_) {}
    ~TemporaryName() { ::unlink(path_.c_str()); }
    TemporaryName(const TemporaryName&) = delete;
    TemporaryName& operator=(const TemporaryName&) = delete;
    const fs::path& path() const { return path_; }

 private:
    fs::path path_;
    Unfinished listed_;
};

void sync_folder(const fs::path& file) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    const OpenedFile opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (opened.get() >= 0) ::fsync(opened.get());
}

void check_owner(const fs::path& path, const struct stat& info) {
    if (!S_ISREG(info.st_mode)) refuse(path, "it is no regular file", "name the key file itself");
    if (info.st_uid != ::geteuid()) {
        refuse(path, "it belongs to another user", "use a key of your own: qchopper keys make");
    }
    if ((info.st_mode & others) != 0) {
        char mode[8];
        std::snprintf(mode, sizeof mode, "%04o", static_cast<unsigned>(info.st_mode & 07777U));
        refuse(path, std::string("other users may have read it (mode ") + mode + ")",
               "take it for known to others: revoke it and make another; or, if nobody else uses this computer, chmod "
               "600");
    }
}

std::string read_whole(int fd, const fs::path& path) {
    std::string text(max_bytes + 1, '\0');
    std::size_t filled = 0;
    for (;;) {
        const ssize_t got = ::read(fd, text.data() + filled, text.size() - filled);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw InputError(InputFault::missing, path.string() + " cannot be read: " + reason());
        filled += static_cast<std::size_t>(got);
        if (got == 0 || filled == text.size()) break;
    }
    if (filled > max_bytes) refuse(path, "it is larger than any key", "name the key file itself");
    text.resize(filled);
    return text;
}

[[noreturn]] void refuse(const fs::path& path, PemFault fault) {
    if (fault == PemFault::other_kind) {
        refuse(path, "it holds no Ed25519 key but something of another kind", "make one by: qchopper keys make NAME");
    }
    refuse(path, "it is cut short or damaged", restore);
}

}  // namespace

void write_private_key(const fs::path& path, const Ed25519PrivateKey& key, std::string_view passphrase) {
    const TemporaryName temporary(path.parent_path() / temporary_name(path.filename().string()));
    const OpenedFile file(
        ::open(temporary.path().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, S_IRUSR | S_IWUSR));
    if (file.get() < 0) throw InputError(InputFault::create, path.string() + " cannot be created: " + reason());
    write_whole(file.get(), path, to_pem(key, passphrase) + to_pem(key.public_key()));
    if (::link(temporary.path().c_str(), path.c_str()) != 0) {
        throw InputError(InputFault::create, path.string() + " cannot be created: " + reason(),
                         "a key is never replaced: choose another name");
    }
    sync_folder(path);
}

PrivateKeyFile read_private_key(const fs::path& path) {
    const OpenedFile file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
    if (file.get() < 0 && errno == ELOOP) {
        refuse(path, "it is a symbolic link, whose target others may change", "name the key file itself");
    }
    if (file.get() < 0) {
        throw InputError(InputFault::missing, "the private key " + path.string() + " cannot be opened: " + reason(),
                         "see the keys that are there by: qchopper keys show");
    }
    struct stat info {};
    if (::fstat(file.get(), &info) != 0) throw InputError(InputFault::missing, path.string() + " cannot be read");
    check_owner(path, info);
    PrivateKeyFile found{path, {}, false, read_whole(file.get(), path)};
    if (found.pem.empty()) refuse(path, "it is empty", restore);
    found.is_encrypted = is_encrypted_pem(found.pem);
    if (!found.is_encrypted) {
        const auto plain = private_key_from_pem(found.pem, {});
        if (!plain.key) refuse(path, plain.fault);
    }
    const auto shown = public_key_from_pem(found.pem);
    if (!shown.key) refuse(path, PemFault::no_pem);  // the private key before it is one of the right kind
    found.public_key = *shown.key;
    return found;
}

std::optional<Ed25519PrivateKey> open_private_key(const PrivateKeyFile& file, std::string_view passphrase) {
    constexpr std::chrono::seconds wrong_takes(1);
    const auto began = std::chrono::steady_clock::now();
    const auto opened = private_key_from_pem(file.pem, passphrase);
    if (opened.fault == PemFault::wrong_passphrase) {
        std::this_thread::sleep_until(began + wrong_takes);
        return std::nullopt;
    }
    if (!opened.key) refuse(file.path, opened.fault);
    if (opened.key->public_key() != file.public_key) {
        refuse(file.path, "its private key is not that of the public key in the same file", restore);
    }
    return opened.key;
}

}  // namespace qchopper
