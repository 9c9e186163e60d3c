// Long work of the console: commands of this program, run one at a time as processes of their own.
//
// So a work can be stopped or killed at any moment like a command in a terminal, what it has saved stays, and what it
// answers is the document of the command (tests/app/console/works_test.cpp).

#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/console/console_state.h"

namespace qchopper {

struct WorkOrder {
    WorkKind kind = WorkKind::check;
    std::string of;                  // the id of a project or check; empty: none yet
    std::vector<std::string> words;  // program and arguments
    // Makes the result of the document that the command has printed; empty: the result is that document. May take long;
    // it is called by the thread that runs the work.
    std::function<JsonText(const JsonText&)> result = {};
};

class Works {
 public:
    // `on_change` is called with a work that has changed, from several threads.
    explicit Works(std::function<void(const Work&)> on_change);
    ~Works();  // stops what runs
    Works(const Works&) = delete;
    Works& operator=(const Works&) = delete;

    // Returns the id. Nothing: too many wait.
    std::optional<std::string> begin(WorkOrder order);
    // False: there is no such work. One that is over stays as it is.
    bool stop(const std::string& id);
    // The newest first; those that are over as far as they are kept.
    std::vector<Work> all() const;
    std::optional<Work> find(const std::string& id) const;
    // Whether one of this project waits or runs.
    bool is_busy(const std::string& of) const;

 private:
    struct Entry {
        Work work;
        WorkOrder order;
        std::chrono::steady_clock::time_point began = {};
    };
    void run(const std::stop_token& stop);
    void run_one(Entry& entry, const std::stop_token& stop);
    void take_line(Entry& entry, const std::string& line);
    void fail(Entry& entry, const std::string& why);
    void end(Entry& entry, int code, const std::string& document);
    void told(const Entry& entry) const;
    void drop_old();

    std::function<void(const Work&)> on_change_;
    mutable std::mutex changing_;
    std::condition_variable_any changed_;
    std::deque<std::shared_ptr<Entry>> entries_;  // the oldest first
    std::size_t begun_ = 0;
    std::jthread runner_;  // the last member: it ends before the others
};

}  // namespace qchopper
