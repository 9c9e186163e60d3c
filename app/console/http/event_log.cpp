// One list for all readers; each reader has a number. O(events that are new) a read.

#include "app/console/http/event_log.h"

#include <charconv>
#include <set>

namespace qchopper {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds tick_interval{2};
constexpr std::chrono::milliseconds least_interval{100};  // at most ten times a second
constexpr std::size_t most_bytes = 1 << 20;

}  // namespace

EventLog::EventLog(std::string server, std::size_t kept) : server_(std::move(server)), kept_(kept) {}

void EventLog::publish(const std::string& name, const std::string& data, const std::string& subject) {
    {
        const std::lock_guard lock(changing_);
        events_.push_back({++newest_, name, data, subject});
        if (events_.size() > kept_) events_.pop_front();
    }
    changed_.notify_all();
}

std::string EventLog::newest() const {
    const std::lock_guard lock(changing_);
    return id(newest_);
}

std::optional<std::uint64_t> EventLog::number_of(const std::string& event) const {
    if (!event.starts_with(server_ + "-")) return {};
    const char* const begin = event.data() + server_.size() + 1;
    const char* const end = event.data() + event.size();
    std::uint64_t number = 0;
    const auto [last, error] = std::from_chars(begin, end, number);
    if (error != std::errc() || last != end) return {};
    return number;
}

std::unique_ptr<EventLog::Reader> EventLog::reader(const std::string& after) const {
    const std::lock_guard lock(changing_);
    const std::optional<std::uint64_t> number = number_of(after);
    const std::uint64_t oldest = newest_ - events_.size();  // the last one that is not kept
    const bool is_known = number && *number >= oldest && *number <= newest_;
    return std::unique_ptr<Reader>(new Reader(*this, is_known ? *number : newest_, !is_known));
}

void EventLog::end() {
    {
        const std::lock_guard lock(changing_);
        has_ended_ = true;
    }
    changed_.notify_all();
}

std::string EventLog::Reader::frame(const Event& event) const {
    return "id: " + log_.id(event.number) + "\nevent: " + event.name + "\ndata: " + event.data + "\n\n";
}

std::string EventLog::Reader::reset_frame(std::uint64_t number) const {
    return "id: " + log_.id(number) + "\nevent: reset\ndata: {}\n\n";
}

std::optional<std::string> EventLog::Reader::next(std::chrono::milliseconds limit) {
    std::unique_lock lock(log_.changing_);
    const auto may_send = [&] { return log_.has_ended_ || log_.newest_ > got_ || begins_anew_; };
    const Clock::time_point until = Clock::now() + limit;
    log_.changed_.wait_until(lock, until, may_send);
    if (log_.has_ended_) return {};
    const Clock::time_point now = Clock::now();
    if (sent_ + least_interval > now && log_.newest_ > got_) {  // what comes meanwhile goes with it
        log_.changed_.wait_until(lock, sent_ + least_interval, [&] { return log_.has_ended_; });
        if (log_.has_ended_) return {};
    }
    std::string text;
    if (begins_anew_) text += reset_frame(got_);
    begins_anew_ = false;
    if (log_.newest_ - log_.events_.size() > got_) return {};  // it missed some: it begins again with a new stream
    std::set<std::pair<std::string, std::string>> newer;
    std::deque<const Event*> wanted;
    for (auto event = log_.events_.rbegin(); event != log_.events_.rend() && event->number > got_; ++event) {
        if (event->subject.empty() || newer.emplace(event->name, event->subject).second) wanted.push_front(&*event);
    }
    for (const Event* const event : wanted) text += frame(*event);
    if (text.size() > most_bytes) {
        if (sent_ != Clock::time_point()) return {};
        // One that has got nothing yet would come again and again for the same events.
        text = reset_frame(log_.newest_);
    }
    got_ = log_.newest_;
    if (!text.empty()) sent_ = Clock::now();
    if (Clock::now() - ticked_ >= tick_interval) {
        ticked_ = Clock::now();
        text += "event: tick\ndata: {}\n\n";
    }
    return text;
}

}  // namespace qchopper
