// One lock per process is held while it works; who waits for it has a number, and a newer one of the same lane sends
// older ones away. O(requests that wait).

#include "app/console/worker/worker_process.h"

#include <algorithm>
#include <condition_variable>
#include <system_error>

#include "base/child_process.h"

namespace qchopper {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

class WorkerProcesses::Process {
 public:
    Process(std::filesystem::path folder, std::vector<std::string> words)
        : folder_(std::move(folder)), words_(std::move(words)) {}

    const std::filesystem::path& folder() const { return folder_; }

    // Nothing: it has ended, and nothing of the request was done.
    std::optional<WorkerAnswer> ask(const WorkerRequest& request, const std::string& lane) {
        std::unique_lock lock(changing_);
        const std::size_t number = ++asked_;
        if (!lane.empty()) newest_[lane] = number;
        const auto is_superseded = [&] { return !lane.empty() && newest_[lane] != number; };
        turn_changed_.notify_all();
        turn_changed_.wait(lock, [&] { return has_ended_ || !is_busy_ || is_superseded(); });
        if (has_ended_) return {};
        if (is_superseded()) {
            return error_answer(409, "a newer question has taken the place of this one", "Nothing was changed.", "");
        }
        is_busy_ = true;
        lock.unlock();
        std::optional<WorkerAnswer> answer;
        try {
            answer = answer_of(request);
        } catch (const std::system_error& e) {
            answer = error_answer(500, std::string("no process can be started: ") + e.what(), "Nothing was changed.",
                                  "end other programs, then ask again");
        }
        lock.lock();
        is_busy_ = false;
        used_ = Clock::now();
        turn_changed_.notify_all();
        return answer;
    }

    bool is_idle_since(Clock::time_point time) {
        const std::lock_guard lock(changing_);
        return !is_busy_ && used_ <= time;
    }

    void end() {
        std::shared_ptr<TalkingChild> child;
        {
            const std::lock_guard lock(changing_);
            has_ended_ = true;
            child = child_;
        }
        turn_changed_.notify_all();
        if (child != nullptr) child->kill();
    }

 private:
    // Precondition: is_busy_ is this caller's. A process that has ended may have been killed before it took the
    // request, so that what changes nothing is asked once more, of another one.
    std::optional<WorkerAnswer> answer_of(const WorkerRequest& request) {
        for (int attempt = 0; attempt < 2; ++attempt) {
            const std::shared_ptr<TalkingChild> child = running();
            if (child == nullptr) return {};
            const bool is_sent = child->write_line(to_line(request));
            while (is_sent && !child->has_ended()) {
                const std::optional<TalkingChild::Line> line = child->read_line(1s);
                if (!line || line->is_error) continue;
                if (std::optional<WorkerAnswer> answer = read_answer(line->text)) return answer;
            }
            forget_child();
            if (is_sent && request.task == WorkerTask::decide) break;
        }
        return lost();
    }

    static WorkerAnswer lost() {
        return error_answer(500, "the process that holds the project ended without an answer",
                            "What was decided before is kept; whether this was decided, the project shows.",
                            "look at the project, then ask again");
    }

    void forget_child() {
        const std::lock_guard lock(changing_);
        child_.reset();
    }

    std::shared_ptr<TalkingChild> running() {
        const std::lock_guard lock(changing_);
        if (has_ended_) return {};
        if (child_ == nullptr) child_ = std::make_shared<TalkingChild>(words_);
        return child_;
    }

    const std::filesystem::path folder_;
    const std::vector<std::string> words_;
    std::mutex changing_;
    std::condition_variable turn_changed_;
    std::map<std::string, std::size_t> newest_;  // of each lane the number of the newest request
    std::size_t asked_ = 0;
    bool is_busy_ = false;
    bool has_ended_ = false;
    Clock::time_point used_ = Clock::now();
    std::shared_ptr<TalkingChild> child_;
};

WorkerProcesses::WorkerProcesses(std::function<std::vector<std::string>(const std::filesystem::path&)> words_for,
                                 std::size_t most)
    : words_for_(std::move(words_for)), most_(most) {}

WorkerProcesses::~WorkerProcesses() {
    end();
}

WorkerAnswer WorkerProcesses::ask(const std::filesystem::path& folder, const WorkerRequest& request,
                                  const std::string& lane) {
    while (const std::shared_ptr<Process> process = process_of(folder)) {
        if (std::optional<WorkerAnswer> answer = process->ask(request, lane)) return std::move(*answer);
    }
    const std::lock_guard lock(changing_);
    if (has_ended_) return error_answer(503, "the server ends", "Nothing was changed.", "start it again");
    return error_answer(503, "as many projects are being worked on as this server holds at once",
                        "Nothing was changed.", "wait until one of them has its answer");
}

// Nothing: all that may run are at work.
std::shared_ptr<WorkerProcesses::Process> WorkerProcesses::process_of(const std::filesystem::path& folder) {
    const std::lock_guard lock(changing_);
    if (has_ended_) return {};
    const auto found = std::ranges::find_if(processes_, [&](const auto& p) { return p->folder() == folder; });
    if (found != processes_.end()) {
        processes_.splice(processes_.begin(), processes_, found);
        return processes_.front();
    }
    while (processes_.size() >= most_) {
        const auto is_idle = [](const auto& p) { return p->is_idle_since(Clock::now()); };
        const auto idle = std::find_if(processes_.rbegin(), processes_.rend(), is_idle);
        if (idle == processes_.rend()) return {};
        (*idle)->end();
        processes_.erase(std::next(idle).base());
    }
    processes_.push_front(std::make_shared<Process>(folder, words_for_(folder)));
    return processes_.front();
}

void WorkerProcesses::end_idle(Clock::duration limit) {
    const std::lock_guard lock(changing_);
    processes_.remove_if([&](const std::shared_ptr<Process>& process) {
        if (!process->is_idle_since(Clock::now() - limit)) return false;
        process->end();
        return true;
    });
}

void WorkerProcesses::end() {
    const std::lock_guard lock(changing_);
    has_ended_ = true;
    for (const auto& process : processes_) process->end();
    processes_.clear();
}

}  // namespace qchopper
