// A dispatcher as a process of its own, which ends by SIGKILL at a named point of its course: run by crash_test.cpp.
//
//   dispatch_once PORT STATE_FOLDER DROP_FOLDER [POINT [COUNT]]
//
// Takes up what an earlier run left in the journal, then dispatches one job, whose file is always the same. Prints the
// verdict of each hand-off, its job id, and STARTS. At the COUNT-th time (1) that POINT is passed it kills itself; the
// point "?" prints every point instead. Only this test program has such points: in the released program the hook is
// empty.

#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <set>

#include "app/dispatch/dispatch_jobs.h"
#include "devices/hand_off/journal_history.h"
#include "devices/journal/journal.h"
#include "devices/wire/modbus_tcp.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

int run(int argc, char** argv) {
    const auto port = static_cast<std::uint16_t>(std::atoi(argv[1]));
    const std::string point = argc > 4 ? argv[4] : "";
    int left = argc > 5 ? std::atoi(argv[5]) : 1;
    std::set<std::string> seen;
    const rig::Job job = rig::make_job(100, 2);
    DispatchOptions options = rig::quick_dispatch(argv[3]);
    options.again = false;
    options.at_point = [&](const std::string& passed) {
        if (point == "?" && seen.insert(passed).second) std::printf("point %s\n", passed.c_str());
        if (passed == point && --left == 0) raise(SIGKILL);
    };
    ModbusTcpBus bus({"127.0.0.1", port});
    Journal journal(argv[2], {any_cell_id, true, "crash test"});
    PieceJob piece_job;
    piece_job.piece = "A";
    piece_job.file = job.file;
    piece_job.ticket = job.ticket;
    const std::vector<DispatchedJob> handed = dispatch_jobs({piece_job}, bus, options, journal, ProjectContext{});
    for (const DispatchedJob& one : handed) {
        std::printf("%s|%s|%d|%d\n", describe(one.outcome.start_outcome), to_text(one.outcome.job_id).c_str(),
                    one.outcome.is_complete() ? 1 : 0, one.outcome.milled_before ? 1 : 0);
    }
    return 0;
}

}  // namespace
}  // namespace qchopper

int main(int argc, char** argv) {
    try {
        return argc < 4 ? 64 : qchopper::run(argc, argv);
    } catch (const std::exception& error) {
        std::printf("error|%s\n", error.what());
        return 1;
    }
}
