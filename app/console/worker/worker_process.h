// The processes that hold projects for the console, from the side of the server (worker.h is the other side).
//
// At most two run, those whose projects were used last; one at work is not ended for another project, whose request is
// then answered with 503. A process that has ended is started again for the next request. Functions may be called from
// any thread (tests/app/console/worker_process_test.cpp).

#pragma once

#include <chrono>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "app/console/worker/worker.h"

namespace qchopper {

class WorkerProcesses {
 public:
    // `words_for`: program and arguments of the process that holds a project folder.
    explicit WorkerProcesses(std::function<std::vector<std::string>(const std::filesystem::path&)> words_for,
                             std::size_t most = 2);
    ~WorkerProcesses();
    WorkerProcesses(const WorkerProcesses&) = delete;
    WorkerProcesses& operator=(const WorkerProcesses&) = delete;

    // Waits for its turn and for the answer. `lane`: of the requests that wait with the same lane all but the newest
    // are answered with 409; empty: each is done.
    WorkerAnswer ask(const std::filesystem::path& folder, const WorkerRequest& request, const std::string& lane = {});

    // Ends those that have answered nothing for so long.
    void end_idle(std::chrono::steady_clock::duration limit);
    // Ends all; what waits is answered with 503.
    void end();

 private:
    class Process;
    std::shared_ptr<Process> process_of(const std::filesystem::path& folder);

    std::function<std::vector<std::string>(const std::filesystem::path&)> words_for_;
    std::size_t most_;
    std::mutex changing_;
    std::list<std::shared_ptr<Process>> processes_;  // the one used last first
    bool has_ended_ = false;
};

}  // namespace qchopper
