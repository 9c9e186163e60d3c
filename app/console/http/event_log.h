// Events for the pages that are open: the newest are kept, so that a page that lost its connection misses none.
//
// The form is that of server-sent events (HTML Standard, WHATWG, 9.2). Ids are SERVER-N with N from 1 up. All functions
// may be called from any thread (tests/app/console/event_log_test.cpp).

#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace qchopper {

class EventLog {
 public:
    // `server`: the id of this run of the server.
    explicit EventLog(std::string server, std::size_t kept = 4096);

    // Adds an event with its data, one line of JSON. `subject`: of events with the same name and subject, only the
    // newest is sent to a client that has not got the older ones yet; empty: each is sent.
    void publish(const std::string& name, const std::string& data, const std::string& subject = {});

    // The id of the newest event.
    std::string newest() const;

    // What one client has got.
    class Reader;
    // After the event of this id. If it is not of this server, or too old, the reader begins with the event reset and
    // goes on with what is published from now on; so does one for whom more than 1 MB is kept. A stream for which so
    // much waits later ends.
    std::unique_ptr<Reader> reader(const std::string& after) const;

    // Streams end.
    void end();

 private:
    struct Event {
        std::uint64_t number;
        std::string name;
        std::string data;
        std::string subject;
    };
    std::string id(std::uint64_t number) const { return server_ + "-" + std::to_string(number); }
    std::optional<std::uint64_t> number_of(const std::string& event) const;

    std::string server_;
    std::size_t kept_;
    mutable std::mutex changing_;
    mutable std::condition_variable changed_;
    std::deque<Event> events_;
    std::uint64_t newest_ = 0;
    bool has_ended_ = false;
};

class EventLog::Reader {
 public:
    // Waits at most so long for events and returns them as a stream has them; empty: there were none. Every 2 s there
    // is one named tick. Nothing: the stream is over.
    std::optional<std::string> next(std::chrono::milliseconds limit);

 private:
    friend class EventLog;
    Reader(const EventLog& log, std::uint64_t got, bool begins_anew)
        : log_(log), got_(got), begins_anew_(begins_anew), ticked_(std::chrono::steady_clock::now()) {}

    std::string frame(const Event& event) const;
    std::string reset_frame(std::uint64_t number) const;

    const EventLog& log_;
    std::uint64_t got_;
    bool begins_anew_;
    std::chrono::steady_clock::time_point ticked_;
    std::chrono::steady_clock::time_point sent_ = {};
};

}  // namespace qchopper
