#include "base/files/temporary_name.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <string>
#include <string_view>

namespace qchopper {
namespace {

// What a process that has ended wrote.
std::string by_another_process(const std::function<std::string()>& make) {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const std::string text = make();
        const bool is_written = ::write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size());
        ::_exit(is_written ? 0 : 1);
    }
    ::close(ends[1]);
    std::string text(4096, '\0');
    const ssize_t got = ::read(ends[0], text.data(), text.size());
    ::close(ends[0]);
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return text;
}

TEST(TemporaryName, IsAnotherOneEachTimeAndBeginsWithTheName) {
    const std::string one = temporary_name("A.ply");
    EXPECT_NE(one, temporary_name("A.ply"));
    EXPECT_TRUE(one.starts_with("A.ply.tmp.")) << one;
    EXPECT_LE(one.size(), std::string("A.ply").size() + 60);
}

TEST(TemporaryName, IsALeftoverOnceItsProcessHasEnded) {
    EXPECT_FALSE(is_leftover(temporary_name("A.ply"))) << "this process has not";
    const std::string left = by_another_process([] { return temporary_name("a b.tmp.c-d.qch"); });
    EXPECT_TRUE(is_leftover(left)) << left;
}

TEST(TemporaryName, ThatOthersChoseIsNoLeftover) {
    std::string left = by_another_process([] { return temporary_name("A.ply"); });
    ASSERT_TRUE(is_leftover(left)) << left;
    EXPECT_FALSE(is_leftover("B" + left)) << "of another name";
    left.back() = left.back() == '0' ? '1' : '0';
    EXPECT_FALSE(is_leftover(left)) << "of another checksum";
    for (const char* name :
         {"", "A.ply", "A.ply.tmp.", "A.ply.tmp.1", "A.ply.tmp.here.1.00000000-00000000", "my-notes"}) {
        EXPECT_FALSE(is_leftover(name)) << name;
    }
}

TEST(TemporaryName, OfAnotherMachineIsNoLeftover) {
    const std::string left = by_another_process([] {
        constexpr std::string_view elsewhere = "elsewhere";
        if (::unshare(CLONE_NEWUTS) != 0 && ::unshare(CLONE_NEWUTS | CLONE_NEWUSER) != 0) return std::string("none");
        if (::sethostname(elsewhere.data(), elsewhere.size()) != 0) return std::string("none");
        return temporary_name("A.ply");
    });
    if (left == "none") GTEST_SKIP() << "skipped: this system lets nobody have a host name of his own";
    EXPECT_NE(left.find(".tmp.elsewhere."), std::string::npos) << left;
    EXPECT_FALSE(is_leftover(left));
}

}  // namespace
}  // namespace qchopper
