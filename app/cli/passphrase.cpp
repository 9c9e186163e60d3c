// Reads a byte at a time, so that nothing after the line is taken, and looks for a stop in between.

#include "app/cli/passphrase.h"

#include <fcntl.h>
#include <poll.h>
#include <string.h>  // NOLINT(modernize-deprecated-headers): explicit_bzero
#include <termios.h>
#include <unistd.h>

#include <cerrno>

#include "app/cli/terminal.h"
#include "app/dispatch/signing.h"
#include "base/error.h"
#include "base/printable.h"

namespace qchopper {
namespace {

constexpr int tries_at_a_terminal = 3;

// Without an echo while it lives.
class QuietTerminal {
 public:
    QuietTerminal() : fd_(::open("/dev/tty", O_RDWR | O_NOCTTY | O_CLOEXEC)) {
        if (fd_ < 0 || ::tcgetattr(fd_, &before_) != 0) {
            if (fd_ >= 0) ::close(fd_);
            throw InputError(InputFault::use, "a passphrase is asked for, and there is no terminal for it",
                             Sentence::with_key("give_passphrase", {}, "give the passphrase by a descriptor"));
        }
        termios quiet = before_;
        quiet.c_lflag &= ~static_cast<tcflag_t>(ECHO);
        ::tcsetattr(fd_, TCSAFLUSH, &quiet);
    }
    ~QuietTerminal() {
        ::tcsetattr(fd_, TCSAFLUSH, &before_);
        ::close(fd_);
    }
    QuietTerminal(const QuietTerminal&) = delete;
    QuietTerminal& operator=(const QuietTerminal&) = delete;
    int fd() const { return fd_; }
    void say(const std::string& text) const {
        const ssize_t ignored = ::write(fd_, text.data(), text.size());
        static_cast<void>(ignored);
    }

 private:
    int fd_;
    termios before_{};
};

Passphrase read_line(int fd) {
    Passphrase passphrase;
    for (;;) {
        pollfd input{fd, POLLIN, 0};
        constexpr int look_ms = 50;
        const int ready = ::poll(&input, 1, look_ms);
        if (Terminal::is_cancelled()) throw Cancelled();
        if (ready <= 0) continue;
        char c = 0;
        const ssize_t got = ::read(fd, &c, 1);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) {
            throw InputError(InputFault::use,
                             "no passphrase can be read from descriptor " + std::to_string(fd) + ": " +
                                 ::strerror(errno),  // NOLINT(concurrency-mt-unsafe)
                             "open it for reading, for example: 3<FILE");
        }
        if (got == 0 || c == '\n') return passphrase;
        if (!passphrase.add(c)) throw InputError(InputFault::use, "the passphrase is too long", "use a shorter one");
    }
}

void refuse_empty(const Passphrase& passphrase) {
    if (!passphrase.text().empty()) return;
    throw InputError(InputFault::use, "the passphrase is empty",
                     Sentence::with_key("make_key_without_passphrase", {}, "type one"));
}

// One line from the descriptor, or from the terminal without an echo after the question.
Passphrase read_passphrase(const std::optional<int>& fd, const std::string& question) {
    if (fd) return read_line(*fd);
    const QuietTerminal terminal;
    terminal.say(question);
    Passphrase passphrase = read_line(terminal.fd());
    terminal.say("\n");
    return passphrase;
}

}  // namespace

Passphrase::~Passphrase() {
    ::explicit_bzero(text_.data(), text_.size());
}

bool Passphrase::add(char c) {
    if (text_.size() + 1 >= capacity) return false;
    text_ += c;
    return true;
}

Passphrase new_passphrase(const std::optional<int>& fd, const std::string& name) {
    Passphrase first = read_passphrase(fd, "Passphrase for the new key " + printable(name) + ": ");
    refuse_empty(first);
    if (!fd && read_passphrase(fd, "The same again: ").text() != first.text()) {
        throw InputError(InputFault::use, "the two passphrases differ", "run the command again");
    }
    return first;
}

Ed25519PrivateKey open_own_key(const std::string& key, const std::optional<int>& passphrase_fd) {
    const PrivateKeyFile file = read_own_key(key);
    if (!file.is_encrypted) return *open_private_key(file, {});
    for (int tries = passphrase_fd ? 1 : tries_at_a_terminal; tries > 0; --tries) {
        const Passphrase passphrase =
            read_passphrase(passphrase_fd, "Passphrase of " + printable(file.path.string()) + ": ");
        if (const auto opened = open_private_key(file, passphrase.text())) return *opened;
    }
    throw InputError(
        InputFault::use, "the passphrase of " + file.path.string() + " is wrong",
        "run the command again with the right one; where it is lost, make another key and revoke this one");
}

}  // namespace qchopper
