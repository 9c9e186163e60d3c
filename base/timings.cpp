// Two clocks are read when a stage begins or ends, and the time between two readings goes to the innermost stage:
// O(stages) for each reading, about a microsecond.

#include "base/timings.h"

#include <algorithm>
#include <cassert>
#include <ctime>
#include <utility>

#include "base/process.h"

namespace qchopper {
namespace {

double wall_seconds() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

SpentTime clocks() {
    return {wall_seconds(), cpu_seconds()};
}

SpentTime difference(const SpentTime& later, const SpentTime& earlier) {
    return {later.wall_s - earlier.wall_s, later.cpu_s - earlier.cpu_s};
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

std::size_t Timings::stage_named(const std::string& name) {
    const auto known =
        std::find_if(stages_.begin(), stages_.end(), [&](const StageTime& stage) { return stage.name == name; });
    const auto index = static_cast<std::size_t>(known - stages_.begin());
    if (known == stages_.end()) stages_.push_back({name, {}});
    return index;
}

void Timings::begin(const std::string& name) {
    add_up();
    begun_.push_back(stage_named(name));
}

void Timings::end() {
    assert(!begun_.empty());
    add_up();
    begun_.pop_back();
}

void Timings::divide(const std::vector<RunTimes>& work) {
    assert(!begun_.empty());
    add_up();
    double busy_s = 0;
    std::vector<std::pair<std::size_t, double>> parts;  // a stage, and how long a thread was in it
    for (const RunTimes& one : work) {
        busy_s += one.whole.wall_s;
        for (const StageTime& stage : one.stages) parts.emplace_back(stage_named(stage.name), stage.spent.wall_s);
    }
    if (busy_s <= 0) return;
    const std::size_t divided = begun_.back();
    const SpentTime all = stages_[divided].spent;
    for (const auto& [part, wall_s] : parts) {
        const double share = wall_s / busy_s;
        for (const auto& [stage, sign] : {std::pair(part, 1.0), std::pair(divided, -1.0)}) {
            stages_[stage].spent.wall_s += sign * share * all.wall_s;
            stages_[stage].spent.cpu_s += sign * share * all.cpu_s;
        }
    }
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

void StageTimer::divide(const std::vector<RunTimes>& work) {
    if (timings_ != nullptr) timings_->divide(work);
}

void StageTimer::next(const std::string& name) {
    if (timings_ == nullptr) return;
    timings_->end();
    timings_->begin(name);
}

}  // namespace qchopper
