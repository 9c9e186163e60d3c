#include "app/console/http/event_log.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace qchopper {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

struct Frame {
    std::string id;  // empty: none
    std::string name;
    std::string data;
    bool operator==(const Frame&) const = default;
};

std::string field_of(const std::string& frame, const std::string& name) {
    const std::size_t at = frame.find(name + ": ");
    if (at == std::string::npos) return {};
    const std::size_t begin = at + name.size() + 2;
    return frame.substr(begin, frame.find('\n', begin) - begin);
}

std::vector<Frame> frames_of(const std::string& text) {
    std::vector<Frame> frames;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = text.find("\n\n", at);
        EXPECT_NE(end, std::string::npos) << text;
        if (end == std::string::npos) break;
        const std::string frame = text.substr(at, end + 1 - at);
        frames.push_back({field_of(frame, "id"), field_of(frame, "event"), field_of(frame, "data")});
        at = end + 2;
    }
    return frames;
}

// What a reader gets until nothing comes for a moment, without ticks.
std::vector<Frame> all_of(EventLog::Reader& reader) {
    std::vector<Frame> all;
    while (true) {
        const std::optional<std::string> text = reader.next(150ms);
        if (!text || text->empty()) return all;
        for (Frame& frame : frames_of(*text)) {
            if (frame.name != "tick") all.push_back(std::move(frame));
        }
    }
}

TEST(EventLog, ResumeGivesEveryLaterEventOnceAndInOrder) {
    EventLog log("5e1f");
    for (int i = 1; i <= 50; ++i) log.publish("project", std::to_string(i));
    for (const int after : {0, 1, 2, 17, 48, 49, 50}) {
        const auto reader = log.reader("5e1f-" + std::to_string(after));
        const std::vector<Frame> got = all_of(*reader);
        ASSERT_EQ(got.size(), 50U - static_cast<unsigned>(after));
        for (std::size_t i = 0; i < got.size(); ++i) {
            const std::string number = std::to_string(static_cast<std::size_t>(after) + i + 1);
            EXPECT_EQ(got[i], (Frame{"5e1f-" + number, "project", number}));
        }
    }
    EXPECT_EQ(log.newest(), "5e1f-50");
}

TEST(EventLog, WhoResumesAtAnyMomentWhileEventsComeMissesNoneAndGetsNoneTwice) {
    EventLog log("5e1f");
    std::atomic<bool> is_over = false;
    std::thread writer([&] {
        for (int i = 1; i <= 3000; ++i) {
            log.publish("project", std::to_string(i));
            if (i % 100 == 0) std::this_thread::sleep_for(1ms);
        }
        is_over = true;
    });
    std::string last = "5e1f-0";
    std::vector<std::string> got;
    while (!is_over || last != log.newest()) {
        const auto reader = log.reader(last);
        const std::optional<std::string> text = reader->next(50ms);
        ASSERT_TRUE(text);
        for (const Frame& frame : frames_of(*text)) {
            if (frame.name == "tick") continue;
            ASSERT_EQ(frame.name, "project");
            got.push_back(frame.data);
            last = frame.id;
        }
    }
    writer.join();
    ASSERT_EQ(got.size(), 3000U);
    for (std::size_t i = 0; i < got.size(); ++i) EXPECT_EQ(got[i], std::to_string(i + 1));
}

TEST(EventLog, OfWhatHasTheSameNameAndSubjectOnlyTheNewestWaits) {
    EventLog log("5e1f");
    const auto reader = log.reader("5e1f-0");
    log.publish("work", "1", "W1");
    log.publish("project", "2");
    log.publish("work", "3", "W1");
    log.publish("cell", "4", "W1");
    log.publish("work", "5", "W2");
    log.publish("project", "6");
    log.publish("work", "7", "W1");
    std::string data;
    for (const Frame& frame : all_of(*reader)) data += frame.data;
    EXPECT_EQ(data, "24567");
    log.publish("work", "8", "W1");
    EXPECT_EQ(all_of(*reader).size(), 1U) << "it has got the older one already";
}

TEST(EventLog, AnIdThatIsTooOldForeignOrWrongBeginsAnew) {
    EventLog log("5e1f", 4);
    for (int i = 1; i <= 10; ++i) log.publish("project", std::to_string(i));
    for (const std::string& after :
         {std::string("5e1f-5"), std::string("5e1f-0"), std::string("5e1f-11"),
          std::string("5e1f-18446744073709551616"), std::string("77aa-8"), std::string("5e1f-"), std::string("5e1f--1"),
          std::string("5e1f-8x"), std::string("5e1f8"), std::string(), std::string("\n"), std::string("5e1f-8\n")}) {
        const auto reader = log.reader(after);
        const std::vector<Frame> got = all_of(*reader);
        ASSERT_EQ(got.size(), 1U) << after;
        EXPECT_EQ(got[0], (Frame{"5e1f-10", "reset", "{}"})) << after;
    }
    const auto reader = log.reader("5e1f-6");
    EXPECT_EQ(all_of(*reader).size(), 4U) << "the oldest that is kept is 7";
    const auto anew = log.reader("");
    log.publish("project", "11");
    const std::vector<Frame> got = all_of(*anew);
    ASSERT_EQ(got.size(), 2U);
    EXPECT_EQ(got[1].data, "11");
}

TEST(EventLog, AClientThatIsTooSlowIsClosedAndThenBeginsAnew) {
    EventLog log("5e1f", 4);
    const auto reader = log.reader("5e1f-0");
    for (int i = 1; i <= 5; ++i) log.publish("project", std::to_string(i));
    EXPECT_FALSE(reader->next(1s)) << "one of its events is not kept any more";
}

TEST(EventLog, AClientWithAMegabyteWaitingIsClosedAndComesBackOnce) {
    EventLog log("5e1f");
    const auto reader = log.reader("5e1f-0");
    log.publish("project", "0");
    ASSERT_EQ(all_of(*reader).size(), 1U);
    for (int i = 1; i <= 20; ++i) log.publish("project", std::string(100'000, 'a'));
    EXPECT_FALSE(reader->next(1s));
    const auto again = log.reader("5e1f-1");
    const std::vector<Frame> got = all_of(*again);
    ASSERT_EQ(got.size(), 1U) << "the same events would close it again, for ever";
    EXPECT_EQ(got[0], (Frame{"5e1f-21", "reset", "{}"}));
    log.publish("project", "22");
    EXPECT_EQ(all_of(*again).size(), 1U);
}

TEST(EventLog, AtMostTenTimesASecondSomethingIsSent) {
    EventLog log("5e1f");
    const auto reader = log.reader("5e1f-0");
    std::atomic<bool> is_over = false;
    std::thread writer([&] {
        while (!is_over) {
            log.publish("work", "1", "W1");
            std::this_thread::sleep_for(1ms);
        }
    });
    std::vector<Clock::time_point> times;
    const Clock::time_point end = Clock::now() + 1s;
    while (Clock::now() < end) {
        const std::optional<std::string> text = reader->next(250ms);
        if (text && !text->empty()) times.push_back(Clock::now());
    }
    is_over = true;
    writer.join();
    EXPECT_LE(times.size(), 11U);
    EXPECT_GE(times.size(), 3U);
}

TEST(EventLog, ATickComesEveryTwoSeconds) {
    EventLog log("5e1f");
    const auto reader = log.reader("5e1f-0");
    std::vector<Clock::time_point> ticks{Clock::now()};
    const Clock::time_point end = Clock::now() + 5s;
    while (Clock::now() < end) {
        const std::optional<std::string> text = reader->next(250ms);
        ASSERT_TRUE(text);
        for (const Frame& frame : frames_of(*text)) {
            EXPECT_EQ(frame, (Frame{"", "tick", "{}"}));
            ticks.push_back(Clock::now());
        }
    }
    ASSERT_EQ(ticks.size(), 3U);
    for (std::size_t i = 1; i < ticks.size(); ++i) {
        EXPECT_GE(ticks[i] - ticks[i - 1], 1900ms);
        EXPECT_LE(ticks[i] - ticks[i - 1], 3s);
    }
}

TEST(EventLog, AnEndIsToldAtOnce) {
    EventLog log("5e1f");
    const auto reader = log.reader("5e1f-0");
    std::thread ender([&] {
        std::this_thread::sleep_for(100ms);
        log.end();
    });
    const Clock::time_point begin = Clock::now();
    EXPECT_FALSE(reader->next(60s));
    EXPECT_LT(Clock::now() - begin, 10s);
    ender.join();
    EXPECT_FALSE(reader->next(60s));
    const auto later = log.reader("5e1f-0");
    EXPECT_FALSE(later->next(60s));
}

}  // namespace
}  // namespace qchopper
