// A thread runs what waits, in its order. A stop is SIGTERM, and SIGKILL where it is not answered in two seconds.

#include "app/console/works.h"

#include <algorithm>

#include "app/report/notices.h"
#include "base/child_process.h"

namespace qchopper {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr std::size_t most_waiting = 8;
constexpr std::size_t kept_when_over = 32;
constexpr std::size_t kept_messages = 20;
constexpr Clock::duration stop_limit = 2s;
constexpr Clock::duration end_limit = 1s;  // where the server ends, which takes 2 s at most
constexpr int demand_broken = 1;           // app/cli/exit_code.h: finished, with a document

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace

Works::Works(std::function<void(const Work&)> on_change)
    : on_change_(std::move(on_change)), runner_([this](const std::stop_token& stop) { run(stop); }) {}

Works::~Works() {
    {
        const std::lock_guard lock(changing_);
        for (const auto& entry : entries_) {
            if (entry->work.state == WorkState::queued) entry->work.state = WorkState::stopped;
            if (entry->work.state == WorkState::running) entry->work.state = WorkState::stopping;
        }
        runner_.request_stop();
    }
    changed_.notify_all();
    runner_.join();
}

std::optional<std::string> Works::begin(WorkOrder order) {
    auto entry = std::make_shared<Entry>();
    {
        const std::lock_guard lock(changing_);
        const auto is_waiting = [](const auto& e) { return e->work.state == WorkState::queued; };
        const auto waiting = static_cast<std::size_t>(std::count_if(entries_.begin(), entries_.end(), is_waiting));
        if (waiting >= most_waiting) return {};
        entry->work.id = "W" + std::to_string(++begun_);
        entry->work.kind = order.kind;
        entry->work.of = order.of;
        entry->order = std::move(order);
        entries_.push_back(entry);
        drop_old();
        told(*entry);
    }
    changed_.notify_all();
    return entry->work.id;
}

bool Works::stop(const std::string& id) {
    const std::lock_guard lock(changing_);
    for (const auto& entry : entries_) {
        if (entry->work.id != id) continue;
        WorkState& state = entry->work.state;
        if (state == WorkState::queued) state = WorkState::stopped;
        if (state == WorkState::running) state = WorkState::stopping;
        told(*entry);
        changed_.notify_all();
        return true;
    }
    return false;
}

std::vector<Work> Works::all() const {
    const std::lock_guard lock(changing_);
    std::vector<Work> works;
    for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry) works.push_back((*entry)->work);
    return works;
}

std::optional<Work> Works::find(const std::string& id) const {
    for (Work& work : all()) {
        if (work.id == id) return std::move(work);
    }
    return {};
}

bool Works::is_busy(const std::string& of) const {
    const std::lock_guard lock(changing_);
    return std::ranges::any_of(entries_, [&](const auto& e) { return e->work.of == of && !is_over(e->work.state); });
}

// Precondition: it is locked.
void Works::told(const Entry& entry) const {
    if (on_change_) on_change_(entry.work);
}

// Precondition: it is locked.
void Works::drop_old() {
    const auto over = [](const auto& e) { return is_over(e->work.state); };
    auto count = static_cast<std::size_t>(std::count_if(entries_.begin(), entries_.end(), over));
    while (count > kept_when_over) {
        entries_.erase(std::find_if(entries_.begin(), entries_.end(), over));
        --count;
    }
}

void Works::run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        std::shared_ptr<Entry> next;
        {
            std::unique_lock lock(changing_);
            const auto is_queued = [](const auto& e) { return e->work.state == WorkState::queued; };
            changed_.wait(lock, stop, [&] { return std::ranges::any_of(entries_, is_queued); });
            const auto found = std::ranges::find_if(entries_, is_queued);
            if (stop.stop_requested() || found == entries_.end()) return;
            next = *found;
            next->work.state = WorkState::running;
            next->began = Clock::now();
            told(*next);
        }
        try {
            run_one(*next, stop);
        } catch (const std::exception& e) {  // no process can be made, or no result of its document
            fail(*next, e.what());
        }
    }
}

void Works::run_one(Entry& entry, const std::stop_token& stop) {
    TalkingChild child(entry.order.words);
    std::string document;
    std::optional<Clock::time_point> stopped_at;
    while (!child.has_ended()) {
        const std::optional<TalkingChild::Line> line = child.read_line(100ms);
        const std::lock_guard lock(changing_);
        if (line && line->is_error) take_line(entry, line->text);
        if (line && !line->is_error) document += line->text + "\n";
        if (entry.work.state != WorkState::stopping) continue;
        if (!stopped_at) {
            stopped_at = Clock::now();
            child.stop();
        } else if (Clock::now() - *stopped_at > (stop.stop_requested() ? end_limit : stop_limit)) {
            child.kill();
            break;  // its outputs may stay open in a process that it has left behind
        }
    }
    end(entry, child.code(), document);
}

// A line of --progress json. Precondition: it is locked.
void Works::take_line(Entry& entry, const std::string& line) {
    Work& work = entry.work;
    if (const std::optional<ProgressState> state = read_progress(line)) {
        work.what = state->progress;
        work.done = state->done;
        work.total = state->total.value_or(0);
        work.remaining_s = state->left_s;
    } else if (std::optional<std::string> notice = read_notice(line)) {
        work.messages.push_back(std::move(*notice));
        if (work.messages.size() > kept_messages) work.messages.erase(work.messages.begin());
    }
    work.elapsed_s = seconds_since(entry.began);
    told(entry);
}

void Works::fail(Entry& entry, const std::string& why) {
    const std::lock_guard lock(changing_);
    entry.work.elapsed_s = seconds_since(entry.began);
    entry.work.remaining_s.reset();
    entry.work.state = WorkState::failed;
    entry.work.error = {text_of(error_document(why, "What was saved before is kept.", "begin the work again", 1))};
    told(entry);
}

void Works::end(Entry& entry, int code, const std::string& document) {
    JsonText result{document};
    const bool has_document = is_json(document);
    const bool is_done = (code == 0 || code == demand_broken) && has_document;
    if (is_done && entry.order.result) result = entry.order.result(result);
    const std::lock_guard lock(changing_);
    Work& work = entry.work;
    work.elapsed_s = seconds_since(entry.began);
    work.remaining_s.reset();
    if (work.state == WorkState::stopping) {
        work.state = WorkState::stopped;
    } else if (is_done) {
        work.state = WorkState::done;
        work.result = std::move(result);
    } else if (has_document) {
        work.state = WorkState::failed;
        work.error = std::move(result);
    } else {
        work.state = WorkState::lost;
        work.error = {text_of(error_document("the process ended without an answer", "What was saved before is kept.",
                                             "begin the work again", code))};
    }
    told(entry);
}

}  // namespace qchopper
