// A thread looks four times a second at the process that runs and at its cell. What is begun is on the disk before its
// process is, so that a server that is killed in between leaves an entry without a process.

#include "app/console/cells/dispatch_queue.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "app/dispatch/dispatch_project.h"
#include "base/child_process.h"
#include "base/error.h"
#include "base/files/file.h"

namespace qchopper {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

// What a hand-off has printed at its end, as far as it is read here (app/report/cell/dispatch_report.h, notices.h).
struct PrintedJob {
    std::string start_outcome;
    bool is_complete = false;
    std::string why;
};
struct PrintedEnd {
    std::string error;
    std::string unchanged;
    std::vector<std::string> refused;
    std::vector<PrintedJob> jobs;
};

template <class V, Of<PrintedJob> T>
void fields(V& v, T& job) {
    v("start_outcome", job.start_outcome);
    v("ended_complete", job.is_complete);
    v("why", job.why);
}

template <class V, Of<PrintedEnd> T>
void fields(V& v, T& end) {
    v.maybe("error", end.error);
    v.maybe("unchanged", end.unchanged);
    v.maybe("refused", end.refused);
    v.maybe("jobs", end.jobs);
}

namespace {

constexpr auto step_interval = 250ms;
constexpr const char* complete = "complete";

bool is_sent(EntryState state) {
    return state == EntryState::sending || state == EntryState::asks || state == EntryState::carving ||
           state == EntryState::held;
}

std::string text_of_file(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

// Whether the process of an entry runs: one of its number whose arguments name the job.
bool is_running(const QueueEntry& entry) {
    if (entry.process <= 0 || code_of_detached(entry.process)) return false;
    return text_of_file("/proc/" + std::to_string(entry.process) + "/cmdline").find(entry.job) != std::string::npos;
}

// The document that begins with a line "{" and ends with a line "}", between lines of progress.
std::optional<PrintedEnd> printed_end(const std::string& output) {
    std::istringstream lines(output);
    std::string document;
    bool is_inside = false;
    for (std::string line; std::getline(lines, line);) {
        if (line == "{") {
            document.clear();
            is_inside = true;
        }
        if (is_inside && (line.empty() || line.front() != '{' || line == "{")) document += line + "\n";
        if (line == "}") is_inside = false;
    }
    try {
        PrintedEnd end;
        json_values::from_document(document, end, false);
        return end;
    } catch (const std::runtime_error&) {
        return {};
    }
}

}  // namespace

EntryState state_while_sent(const CellView& cell) {
    if (cell.asks) return EntryState::asks;
    const bool is_held =
        cell.state == PackState::held || cell.state == PackState::holding || cell.state == PackState::suspended;
    if (is_held) return EntryState::held;
    if (cell.job_state == JobState::running || cell.job_state == JobState::interrupted) return EntryState::carving;
    return EntryState::sending;
}

QueueEntry ended_by(QueueEntry entry, const std::string& output) {
    const std::optional<PrintedEnd> end = printed_end(output);
    entry.state = EntryState::unknown;
    entry.why = "nobody followed it to its end: ask the cell";
    if (!end) return entry;
    if (!end->error.empty()) {
        const bool is_before = end->unchanged.starts_with(nothing_started);
        entry.state = is_before ? EntryState::not_started : EntryState::unknown;
        entry.why = end->error + ". " + end->unchanged;
        return entry;
    }
    if (!end->refused.empty()) {
        entry.state = EntryState::not_started;
        entry.why = end->refused.front();
        return entry;
    }
    if (end->jobs.empty()) return entry;
    const PrintedJob& job = end->jobs.back();
    entry.why = job.is_complete ? complete : job.why;
    if (job.start_outcome == describe(StartOutcome::not_started)) entry.state = EntryState::not_started;
    if (job.is_complete || job.start_outcome == describe(StartOutcome::started)) entry.state = EntryState::ended;
    return entry;
}

DispatchQueue::DispatchQueue(fs::path folder, std::function<CellView(const QueueEntry&)> cell,
                             std::function<void()> on_change)
    : folder_(std::move(folder)), cell_(std::move(cell)), on_change_(std::move(on_change)) {
    fs::create_directories(folder_);
    if (const std::optional<std::string> holder = writer_of(folder_)) {
        throw InputError(InputFault::busy, "another server of this folder is running: " + *holder,
                         "open its link, or end it; one that only shows may be started beside it");
    }
    lock_.emplace(folder_);
    read_kept();
    runner_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

DispatchQueue::~DispatchQueue() {
    runner_.request_stop();
    runner_.join();
}

void DispatchQueue::add(std::vector<QueueEntry> entries) {
    {
        const std::lock_guard lock(changing_);
        for (QueueEntry& entry : entries) {
            keep(entry);
            entries_.push_back(std::move(entry));
        }
    }
    changed_.notify_all();
    on_change_();
}

void DispatchQueue::pause() {
    {
        const std::lock_guard lock(changing_);
        is_paused_ = true;
    }
    on_change_();
}

void DispatchQueue::go_on() {
    {
        const std::lock_guard lock(changing_);
        is_paused_ = false;
    }
    changed_.notify_all();
    on_change_();
}

bool DispatchQueue::is_paused() const {
    const std::lock_guard lock(changing_);
    return is_paused_;
}

bool DispatchQueue::remove(const std::string& id) {
    {
        const std::lock_guard lock(changing_);
        const auto entry = std::ranges::find(entries_, id, &QueueEntry::id);
        if (entry == entries_.end() || entry->state != EntryState::waiting) return false;
        entry->state = EntryState::removed;
        keep(*entry);
    }
    on_change_();
    return true;
}

std::vector<QueueEntry> DispatchQueue::all() const {
    const std::lock_guard lock(changing_);
    return entries_;
}

fs::path DispatchQueue::output_of(const QueueEntry& entry) const {
    return folder_ / (entry.id + ".log");
}

void DispatchQueue::keep(const QueueEntry& entry) const {
    write_file(folder_ / (entry.id + ".json"), json_values::to_document(entry));
}

// What an earlier server has begun.
void DispatchQueue::read_kept() {
    std::vector<fs::path> files;
    for (const fs::directory_entry& file : fs::directory_iterator(folder_)) {
        if (file.path().extension() == ".json") files.push_back(file.path());
    }
    std::ranges::sort(files);
    for (const fs::path& file : files) {
        QueueEntry entry;
        try {
            const Bytes bytes = read_file(file, settings_limit);
            json_values::from_document({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, entry, false);
        } catch (const std::runtime_error&) {
            continue;  // another file, which is left alone
        }
        const bool is_open = entry.state == EntryState::waiting || is_sent(entry.state);
        if (entry.state == EntryState::waiting) {
            entry.state = EntryState::not_handed_over;
            entry.why = "the server that was to hand it over has ended";
        } else if (is_sent(entry.state) && !is_running(entry)) {
            entry = ended_by(entry, text_of_file(output_of(entry)));
        }
        std::error_code ignored;
        if (!is_open) {
            fs::remove(output_of(entry), ignored);
            fs::remove(file, ignored);
            continue;
        }
        keep(entry);
        entries_.push_back(std::move(entry));
    }
}

void DispatchQueue::begin(QueueEntry& entry) const {
    entry.state = EntryState::sending;
    entry.why.clear();
    keep(entry);
    entry.process = start_detached(entry.words, output_of(entry));
    keep(entry);
}

void DispatchQueue::follow(QueueEntry& entry) const {
    if (is_running(entry)) {
        const CellView cell = cell_(entry);
        const bool is_read = cell.link == CellLinkState::connected;
        if (is_read) entry.state = state_while_sent(cell);
        entry.why = is_read ? "" : "the cell does not answer this server; the hand-off goes on";
        return;
    }
    entry = ended_by(entry, text_of_file(output_of(entry)));
    keep(entry);
}

// Whether something has changed. Precondition: it is locked.
bool DispatchQueue::step() {
    for (QueueEntry& entry : entries_) {
        if (!is_sent(entry.state)) continue;
        const EntryState before = entry.state;
        follow(entry);
        // What follows a job that did not end complete is for a person to decide.
        const bool is_well = entry.state == EntryState::ended && entry.why == complete;
        if (!is_sent(entry.state) && !is_well) is_paused_ = true;
        return entry.state != before;
    }
    const auto next = std::ranges::find(entries_, EntryState::waiting, &QueueEntry::state);
    if (next == entries_.end() || is_paused_) return false;
    begin(*next);
    return true;
}

void DispatchQueue::run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        bool is_changed = false;
        {
            std::unique_lock lock(changing_);
            is_changed = step();
        }
        if (is_changed) on_change_();
        std::unique_lock lock(changing_);
        changed_.wait_for(lock, stop, step_interval, [] { return false; });
    }
}

}  // namespace qchopper
