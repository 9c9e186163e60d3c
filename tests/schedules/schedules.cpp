// Runs schedules by their seeds: scripts/schedules.
//
//   schedules COUNT [FIRST]     seeds FIRST (0) to FIRST + COUNT - 1; exit 1 and the seeds that failed
//   schedules --replay SEED     one seed, with all that happened in it

#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/schedules/schedule.h"

namespace qchopper::schedules {
namespace {

void print(std::uint64_t count, const ScheduleEnd& sum) {
    std::printf("schedules %llu: jobs %d, lost %d, double starts %d, wrong reports %d, hangs %d\n",
                static_cast<unsigned long long>(count), sum.jobs, sum.lost, sum.double_starts, sum.wrong_reports,
                sum.hangs);
    std::printf(
        "  link faults %d, kills %d, power cuts %d, stores lost %d, journals set back %d; said STARTED %d, NOT STARTED "
        "%d, UNKNOWN %d\n",
        sum.link_faults, sum.kills, sum.power_cuts, sum.stores_lost, sum.journals_set_back, sum.said_started,
        sum.said_not_started, sum.said_unknown);
    std::fflush(stdout);
}

int replay(std::uint64_t seed) {
    const ScheduleEnd end = run_schedule(seed, [](const std::string& line) { std::printf("%s\n", line.c_str()); });
    print(1, end);
    return end.is_right() ? 0 : 1;
}

int run(std::uint64_t count, std::uint64_t first) {
    ScheduleEnd sum;
    constexpr std::uint64_t report_every = 1000;
    for (std::uint64_t i = 0; i < count; ++i) {
        const ScheduleEnd end = run_schedule(first + i);
        sum.add(end);
        if (!end.is_right()) std::printf("seed %s failed\n", std::to_string(first + i).c_str());
        if ((i + 1) % report_every == 0) print(i + 1, sum);
    }
    print(count, sum);
    return sum.is_right() ? 0 : 1;
}

}  // namespace
}  // namespace qchopper::schedules

int main(int argc, char** argv) {
    if (argc < 2) return 64;
    const bool replays = std::string(argv[1]) == "--replay" && argc > 2;
    const auto number = [&](int i) { return std::strtoull(argv[i], nullptr, 10); };
    return replays ? qchopper::schedules::replay(number(2))
                   : qchopper::schedules::run(number(1), argc > 2 ? number(2) : 0);
}
