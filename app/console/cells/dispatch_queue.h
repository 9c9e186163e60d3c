// The jobs that the console hands over, one after the other, each by a process of its own that outlives the server.
//
// The next one begins only after the one before ended complete, while this server lives and nobody has paused. A new
// server follows what still runs, shows what was not handed over, and begins nothing. What became of a job that nobody
// followed is UNKNOWN: the cell knows. Functions may be called from any thread
// (tests/app/console/dispatch_queue_test.cpp).

#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/console/cells/cell_view.h"
#include "app/store/project_folder.h"
#include "base/enum_names.h"
#include "base/json_fields.h"

namespace qchopper {

enum class EntryState { waiting, sending, asks, carving, held, ended, not_started, unknown, removed, not_handed_over };

struct QueueEntry {
    std::string id;
    std::string project;  // its id
    std::string piece;
    std::uint16_t part = 1;
    std::string job;      // the SHA-256 of its file
    std::string cell;     // its id
    std::string address;  // of the cell
    EntryState state = EntryState::waiting;
    std::string why;                 // how it ended, or what is said of it
    std::vector<std::string> words;  // program and arguments
    int process = 0;                 // 0: not begun
};

constexpr auto names_of(EntryState) {
    return EnumNames<EntryState, 10>{{{EntryState::waiting, "waiting"},
                                      {EntryState::sending, "sending"},
                                      {EntryState::asks, "asks"},
                                      {EntryState::carving, "carving"},
                                      {EntryState::held, "held"},
                                      {EntryState::ended, "ended"},
                                      {EntryState::not_started, "not_started"},
                                      {EntryState::unknown, "unknown"},
                                      {EntryState::removed, "removed"},
                                      {EntryState::not_handed_over, "not_handed_over"}}};
}

template <class V, Of<QueueEntry> T>
void fields(V& v, T& entry) {
    v("id", entry.id);
    v("project", entry.project);
    v("piece", entry.piece);
    v("part", entry.part);
    v("job", entry.job);
    v("cell", entry.cell);
    v("address", entry.address);
    v("state", entry.state);
    v("why", entry.why);
    v("process", entry.process);
}

// What the cell says of a job whose process runs.
EntryState state_while_sent(const CellView& cell);
// How a job ended whose process has ended; `output` is all that it has printed.
QueueEntry ended_by(QueueEntry entry, const std::string& output);

class DispatchQueue {
 public:
    // `folder` keeps what was begun and what the processes print; it is made. `cell`: how a cell stands.
    // Throws InputError (busy) where another server holds the folder, with its process and start.
    DispatchQueue(std::filesystem::path folder, std::function<CellView(const QueueEntry&)> cell,
                  std::function<void()> on_change);
    ~DispatchQueue();  // what runs goes on
    DispatchQueue(const DispatchQueue&) = delete;
    DispatchQueue& operator=(const DispatchQueue&) = delete;

    void add(std::vector<QueueEntry> entries);
    void pause();
    void go_on();
    bool is_paused() const;
    // False: there is no such entry, or it does not wait.
    bool remove(const std::string& id);
    std::vector<QueueEntry> all() const;

 private:
    void run(const std::stop_token& stop);
    bool step();
    void begin(QueueEntry& entry) const;
    void follow(QueueEntry& entry) const;
    void keep(const QueueEntry& entry) const;
    std::filesystem::path output_of(const QueueEntry& entry) const;
    void read_kept();

    const std::filesystem::path folder_;
    std::optional<ProjectLock> lock_;  // one server hands over and follows
    const std::function<CellView(const QueueEntry&)> cell_;
    const std::function<void()> on_change_;
    mutable std::mutex changing_;
    std::condition_variable_any changed_;
    std::vector<QueueEntry> entries_;
    bool is_paused_ = false;
    std::jthread runner_;  // the last member: it ends before the others
};

}  // namespace qchopper
