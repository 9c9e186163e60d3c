// inotify. O(events) a call, and O(projects) for add().

#include "app/console/folder_watch.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace qchopper {
namespace {

constexpr std::array watched_files{std::string_view("project.json"), std::string_view("lock"),
                                   std::string_view("cell.toml")};
constexpr std::uint32_t entries = IN_CREATE | IN_DELETE | IN_MOVED_FROM | IN_MOVED_TO;
// A lock is written into when it is taken, and closed when it is released. Who only reads it is not told.
constexpr std::uint32_t contents = IN_CLOSE_WRITE | IN_MODIFY;

}  // namespace

FolderWatch::FolderWatch(const std::filesystem::path& folder)
    : notices_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)),
      stop_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)),
      folder_watch_(::inotify_add_watch(notices_, folder.c_str(), entries | IN_ONLYDIR)) {}

FolderWatch::~FolderWatch() {
    if (notices_ >= 0) ::close(notices_);
    if (stop_ >= 0) ::close(stop_);
}

void FolderWatch::add(const std::vector<std::filesystem::path>& projects) const {
    for (const std::filesystem::path& project : projects) {
        static_cast<void>(::inotify_add_watch(notices_, project.c_str(), entries | contents | IN_ONLYDIR));
    }
}

bool FolderWatch::wait(std::chrono::milliseconds limit) const {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point until = Clock::now() + limit;
    while (true) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()).count();
        if (left < 0) return false;
        std::array<pollfd, 2> watched{{{notices_, POLLIN, 0}, {stop_, POLLIN, 0}}};
        if (::poll(watched.data(), watched.size(), static_cast<int>(left)) <= 0) continue;
        if (watched[1].revents != 0) return false;
        if (take_changes()) return true;
    }
}

void FolderWatch::stop() const {
    static_cast<void>(::eventfd_write(stop_, 1) == 0);
}

// Whether one of the events that wait is a change that counts.
bool FolderWatch::take_changes() const {
    bool is_change = false;
    std::array<char, 16'384> buffer{};
    while (true) {
        const ssize_t size = ::read(notices_, buffer.data(), buffer.size());
        if (size <= 0) return is_change;
        for (std::size_t at = 0; at < static_cast<std::size_t>(size);) {
            inotify_event event{};
            std::memcpy(&event, buffer.data() + at, sizeof event);
            const char* const text = buffer.data() + at + sizeof event;
            const std::string_view name(text, ::strnlen(text, event.len));
            at += sizeof event + event.len;
            if (event.wd == folder_watch_ || (event.mask & IN_Q_OVERFLOW) != 0 ||
                std::ranges::find(watched_files, name) != watched_files.end()) {
                is_change = true;
            }
        }
    }
}

}  // namespace qchopper
