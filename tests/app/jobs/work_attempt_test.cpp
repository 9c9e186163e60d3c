// Records of attempts: what they say while they are at work, when they have ended, and after a kill.

#include "app/jobs/work_attempt.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "base/files/temporary_folder.h"
#include "base/process.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

struct Attempts : ::testing::Test {
    TemporaryFolder folder{"attempts-"};
    fs::path attempts = folder.path() / "attempts";
    std::vector<SeenAttempt> seen(const std::string& result = "r") const { return attempts_at(result, attempts); }
};

TEST_F(Attempts, AreAtWorkUntilTheyEnd) {
    EXPECT_TRUE(seen().empty());
    AttemptRecord record("A", "r", attempts);
    ASSERT_EQ(seen().size(), 1U);
    EXPECT_EQ(seen()[0].attempt.piece, "A");
    EXPECT_EQ(seen()[0].attempt.host, host_name());
    EXPECT_EQ(seen()[0].attempt.process, static_cast<std::uint64_t>(::getpid()));
    EXPECT_GT(seen()[0].attempt.process_bytes, 1'000'000U);
    EXPECT_FALSE(seen()[0].has_ended);
    EXPECT_EQ(failures(seen()), 0U);
    EXPECT_TRUE(seen("other").empty());
    int reports = 0;
    Context context;
    context.on_progress = [&](const Progress&) { ++reports; };
    record.watched(context).progress("moves carved", 1, 2);
    EXPECT_EQ(reports, 1);
    record.end(AttemptState::failed, "out of memory");
    ASSERT_EQ(seen().size(), 1U);
    EXPECT_TRUE(seen()[0].has_ended);
    EXPECT_EQ(seen()[0].attempt.stage, "moves carved");
    EXPECT_EQ(seen()[0].attempt.because, "out of memory");
    EXPECT_EQ(failures(seen()), 1U);
    {
        const AttemptRecord stopped("A", "r", attempts);
        EXPECT_EQ(seen().size(), 2U);
    }
    EXPECT_EQ(seen().size(), 1U) << "what was stopped is no failure";
    AttemptRecord("A", "r", attempts).end(AttemptState::made);
    EXPECT_EQ(seen().size(), 2U);
    EXPECT_EQ(failures(seen()), 1U);
}

TEST_F(Attempts, OfAProcessThatWasKilledHasFailed) {
    const pid_t child = ::fork();
    if (child == 0) {
        const AttemptRecord record("A", "r", attempts);
        ::_exit(0);
    }
    ::waitpid(child, nullptr, 0);
    ASSERT_EQ(seen().size(), 1U);
    EXPECT_EQ(seen()[0].attempt.state, AttemptState::at_work);
    EXPECT_TRUE(seen()[0].has_ended);
    EXPECT_EQ(failures(seen()), 1U);
}

TEST_F(Attempts, OfAnotherHostHasEndedWhenItIsSilent) {
    const AttemptRecord record("A", "r", attempts);
    const fs::path file = fs::directory_iterator(attempts)->path();
    std::string text;
    std::getline(std::ifstream(file), text, '\0');
    const std::string host = "\"host\": \"" + host_name();
    ASSERT_NE(text.find(host), std::string::npos) << text;
    std::ofstream(file) << text.replace(text.find(host), host.size(), "\"host\": \"elsewhere");
    ASSERT_EQ(seen().size(), 1U);
    EXPECT_FALSE(seen()[0].has_ended);
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::minutes(3));
    EXPECT_TRUE(seen()[0].has_ended);
    EXPECT_NEAR(seen()[0].age_s, 180, 5);
    // A clock that is an hour ahead.
    fs::last_write_time(file, fs::file_time_type::clock::now() + std::chrono::hours(1));
    EXPECT_EQ(seen()[0].age_s, 0);
}

TEST_F(Attempts, ThatCannotBeReadArePassedOver) {
    fs::create_directories(attempts);
    for (const char* text : {"", "{}", "[1, 2", "\xff", "{\"format\": \"qchopper attempt\", \"schema\": 2}"}) {
        std::ofstream(attempts / "r-vm-1-1.json") << text;
        EXPECT_TRUE(seen().empty()) << text;
    }
    fs::remove(attempts / "r-vm-1-1.json");
    fs::create_directories(attempts / "r-vm-1-2.json");
    EXPECT_TRUE(seen().empty());
}

}  // namespace
}  // namespace qchopper
