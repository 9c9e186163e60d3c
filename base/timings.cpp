// Two clocks are read when a stage begins or ends, and the time between two readings goes to the innermost stage:
// O(stages) for each reading, about a microsecond.

#include "base/timings.h"

#include <sys/resource.h>

#include <algorithm>
#include <cassert>
#include <ctime>

namespace qchopper {
namespace {

double seconds_of(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

SpentTime clocks() {
    return {seconds_of(CLOCK_MONOTONIC), seconds_of(CLOCK_PROCESS_CPUTIME_ID)};
}

SpentTime difference(const SpentTime& later, const SpentTime& earlier) {
    return {later.wall_s - earlier.wall_s, later.cpu_s - earlier.cpu_s};
}

std::size_t peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace

Timings::Timings() : start_(clocks()) {}

SpentTime Timings::since_start() const {
    return difference(clocks(), start_);
}

void Timings::add_up() {
    const SpentTime now = since_start();
    if (!begun_.empty()) {
        SpentTime& spent = stages_[begun_.back()].spent;
        const SpentTime more = difference(now, changed_);
        spent.wall_s += more.wall_s;
        spent.cpu_s += more.cpu_s;
    }
    changed_ = now;
}

void Timings::begin(const std::string& name) {
    add_up();
    const auto known =
        std::find_if(stages_.begin(), stages_.end(), [&](const StageTime& stage) { return stage.name == name; });
    begun_.push_back(static_cast<std::size_t>(known - stages_.begin()));
    if (known == stages_.end()) stages_.push_back({name, {}});
}

void Timings::end() {
    assert(!begun_.empty());
    add_up();
    begun_.pop_back();
}

RunTimes Timings::so_far() const {
    Timings copy = *this;
    copy.add_up();
    return {std::move(copy.stages_), copy.changed_, peak_memory()};
}

StageTimer::StageTimer(Timings* timings, const std::string& name) : timings_(timings) {
    if (timings_ != nullptr) timings_->begin(name);
}

StageTimer::~StageTimer() {
    if (timings_ != nullptr) timings_->end();
}

void StageTimer::next(const std::string& name) {
    if (timings_ == nullptr) return;
    timings_->end();
    timings_->begin(name);
}

}  // namespace qchopper
