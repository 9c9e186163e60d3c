// A list under a mutex, which is kept locked at the end: a file that another thread is about to finish is then removed
// or complete, never renamed after its removal was reported.

#include "base/files/unfinished.h"

#include <map>
#include <mutex>
#include <system_error>
#include <utility>

namespace qchopper {
namespace {

struct Listed {
    std::mutex changing;
    std::map<std::size_t, std::filesystem::path> paths;
    std::size_t next = 0;
};

Listed& listed() {
    static auto* const all = new Listed;  // never destroyed: threads may list paths until the process has ended
    return *all;
}

}  // namespace

Unfinished::Unfinished(std::filesystem::path path) {
    const std::lock_guard lock(listed().changing);
    number_ = listed().next++;
    listed().paths.emplace(number_, std::move(path));
}

Unfinished::~Unfinished() {
    const std::lock_guard lock(listed().changing);
    listed().paths.erase(number_);
}

void remove_unfinished_and_block() {
    listed().changing.lock();
    std::error_code error;
    for (const auto& [number, path] : listed().paths) std::filesystem::remove_all(path, error);
}

}  // namespace qchopper
