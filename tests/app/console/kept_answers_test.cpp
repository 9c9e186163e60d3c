#include "app/console/http/kept_answers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace qchopper {
namespace {

Sha256 hash_of(const std::string& text) {
    return sha256({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

const HttpAnswer conflict = json_answer(409, "conflict");

struct Counted {
    KeptAnswers kept;
    std::atomic<int> made = 0;

    HttpAnswer ask(const std::string& id, const std::string& body) {
        return kept.answer(
            id, hash_of(body), [&] { return json_answer(200, body + " " + std::to_string(++made)); }, conflict);
    }
};

TEST(KeptAnswers, TheSameRequestIsDoneOnceAndAnsweredTheSame) {
    Counted counted;
    EXPECT_EQ(counted.ask("12345678", "cut").body, "cut 1");
    EXPECT_EQ(counted.ask("12345678", "cut").body, "cut 1");
    EXPECT_EQ(counted.ask("12345679", "cut").body, "cut 2");
    EXPECT_EQ(counted.made, 2);
}

TEST(KeptAnswers, AnotherRequestOfTheSameIdIsAConflict) {
    Counted counted;
    counted.ask("12345678", "cut");
    EXPECT_EQ(counted.ask("12345678", "undo").status, 409U);
    EXPECT_EQ(counted.ask("12345678", "cut").body, "cut 1") << "the first one stays";
    EXPECT_EQ(counted.made, 1);
}

TEST(KeptAnswers, EightAtOnceGetTheOneAnswerThatIsMade) {
    for (int round = 0; round < 20; ++round) {
        KeptAnswers kept;
        std::atomic<int> made = 0;
        std::atomic<int> conflicts = 0;
        std::atomic<int> same = 0;
        std::vector<std::thread> threads;
        for (int i = 0; i < 8; ++i) {
            threads.emplace_back([&, i] {
                const bool is_other = i == 7;
                const auto make = [&] {
                    std::this_thread::sleep_for(std::chrono::milliseconds(20));
                    return json_answer(200, std::to_string(++made));
                };
                const HttpAnswer answer = kept.answer("12345678", hash_of(is_other ? "undo" : "cut"), make, conflict);
                if (answer.status == 409) ++conflicts;
                if (answer.body == "1") ++same;
            });
        }
        for (std::thread& thread : threads) thread.join();
        EXPECT_EQ(made, 1);
        EXPECT_EQ(conflicts + same, 8);
        EXPECT_TRUE(conflicts == 1 || conflicts == 7) << conflicts;
    }
}

TEST(KeptAnswers, AThousandAreKept) {
    Counted counted;
    const auto id = [](int i) { return "request-" + std::to_string(i); };
    for (int i = 0; i < 1000; ++i) counted.ask(id(i), "cut");
    for (int i = 0; i < 1000; ++i) counted.ask(id(i), "cut");
    EXPECT_EQ(counted.made, 1000);
    counted.ask(id(1000), "cut");
    counted.ask(id(1), "cut");
    EXPECT_EQ(counted.made, 1001) << "the oldest goes, not the next";
    counted.ask(id(0), "cut");
    EXPECT_EQ(counted.made, 1002);
}

TEST(KeptAnswers, AsManyBytesAreKeptAndTheNewestAnswerInAnyCase) {
    KeptAnswers kept(1000, 1000);
    int made = 0;
    const auto ask = [&](const std::string& id, std::size_t bytes) {
        return kept.answer(
            id, hash_of(id),
            [&] {
                ++made;
                return json_answer(200, std::string(bytes, 'x'));
            },
            conflict);
    };
    for (int i = 0; i < 10; ++i) ask("small-" + std::to_string(i), 100);
    for (int i = 0; i < 10; ++i) ask("small-" + std::to_string(i), 100);
    EXPECT_EQ(made, 10) << "1,000 bytes are kept";
    ask("middle", 250);
    EXPECT_EQ(made, 11);
    ask("small-3", 100);
    EXPECT_EQ(made, 11) << "of the oldest three go, and no more";
    ask("small-2", 100);
    EXPECT_EQ(made, 12);
    ask("big", 5000);
    ask("big", 5000);
    EXPECT_EQ(made, 13) << "an answer that is sent again is never made again at once";
    ask("middle", 250);
    EXPECT_EQ(made, 14) << "all others went for it";
    ask("big", 5000);
    EXPECT_EQ(made, 15) << "and it for the next one";
}

}  // namespace
}  // namespace qchopper
