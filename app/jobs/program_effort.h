// What making and proving the program of a piece costs beside those of other pieces, before it is made, and how much of
// it is done and how long the rest takes while it is made.
//
// Effort is a number without a unit: a machine makes so and so much of it per second. Seconds, mm.

#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

#include "base/context.h"
#include "cam/setup/setup.h"

namespace qchopper {

// By the block, the surface that is milled, and the number of orientations (tests/app/jobs/program_effort_test.cpp).
// O(1).
double program_effort(const Setup& setup);

// A program to be made.
struct PlannedProgram {
    std::string piece;
    double effort = 0;  // above 0
};

// "programs to make, the largest first: E (estimated at 46 % of the work), F (27 %) and 3 more". Precondition: there is
// one.
std::string describe(const std::vector<PlannedProgram>& programs);

// The rest of work whose items are done in their order by several workers: how long until the last one is done.
// `begun` is what is left of the items that are under way, one per worker; `waiting` is taken by the worker that is
// free first. O(items).
double rest_of_work(std::vector<double> begun, const std::vector<double>& waiting);

// Which steps of its program are made of each piece.
enum class ProgramSteps { all, toolpath, after_toolpath };

// Reports per cent of the time that all programs take, so that a caller that goes on evenly finds the time left. Its
// functions may be called from several threads. The context must outlive it.
class ProgramProgress {
 public:
    using Clock = std::chrono::steady_clock;

    // In the order in which they are begun.
    ProgramProgress(const Context& context, const std::vector<PlannedProgram>& programs,
                    ProgramSteps steps = ProgramSteps::all);

    // For the work on one program: the counts of its steps become a share of it.
    Context of(std::size_t index, const Context& context);
    void finish(std::size_t index);
    // Of the time that all take, 0..1, at some moment.
    double share(Clock::time_point now);

 private:
    struct Item {
        double effort = 0;
        double done = 0;    // share
        double read = 0;    // share of the program's bytes, with the part that is being proven
        double before = 0;  // share of the work that is done before that part
        double of_part = 0;
        bool is_begun = false;
        bool is_done = false;
        Clock::time_point begun;
        double seconds = 0;  // of an item that is done
    };
    void take(Item& item, const Progress& step);
    double share_now(Clock::time_point now) const;
    void report();

    const Context& context_;
    double toolpath_share_;  // of the steps of a piece
    std::string what_;
    std::vector<Item> items_;
    Clock::time_point started_;
    std::size_t percent_ = 0;
    std::mutex mutex_;
};

}  // namespace qchopper
