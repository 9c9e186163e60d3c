// Effort is a product of powers of volume, area and orientations, fitted to 28 pieces of three models from 1 to 168 l:
// all within a factor of 2 of what they took. Area counts most, and stock and piece are looked at along each
// orientation, of which each has more to keep clear of. While programs are made their steps say how far they are, by
// the shares of the time that steps take. The rate is that of the work done so far, the rest a list schedule (Graham,
// "Bounds on multiprocessing timing anomalies", 1969): whatever is left goes to the worker that is free first.
// O(programs) per report.

#include "app/jobs/program_effort.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/text.h"

namespace qchopper {
namespace {

// CPU seconds: seconds * litres^by_volume * dm2^by_area * orientations^by_orientations.
constexpr double seconds = 0.5;
constexpr double by_volume = 0.12;
constexpr double by_area = 0.68;
constexpr double by_orientations = 1.4;
constexpr double least = 0.01;    // of a litre and a dm2
constexpr std::size_t named = 6;  // programs in a message

// A step of make_programs by its progress, and the share of it at which the step begins and ends: of the toolpath and
// the program, or of one part.
struct Step {
    std::string_view what;
    double from = 0;
    double to = 0;
};
constexpr double made = 0.5;  // share of toolpath and program, of all steps
constexpr Step toolpath_step{"operations of the toolpath", 0, 0.97};
constexpr std::string_view carving = "moves carved";
constexpr std::array proof_steps{Step{"steps of the program followed", 0, 0.01}, Step{carving, 0.01, 0.75},
                                 Step{"moves held against the piece", 0.75, 0.94},
                                 Step{"orientations closed", 0.94, 0.98}, Step{"rows of the volume measured", 0.98, 1}};
constexpr std::string_view parts_step = "bytes of the program read";  // up to the end of the part that is proven then

double ratio(const Progress& step) {
    return step.total == 0 ? 0 : std::min(1.0, static_cast<double>(step.done) / static_cast<double>(step.total));
}

// Roughing comes first, and its moves cost more than those of finishing.
double at(const Step& of, const Progress& step) {
    constexpr double cost_of_first_moves = 0.8;  // exponent
    const double share = step.what == carving ? std::pow(ratio(step), cost_of_first_moves) : ratio(step);
    return of.from + share * (of.to - of.from);
}

double toolpath_share(ProgramSteps steps) {
    if (steps == ProgramSteps::all) return made;
    return steps == ProgramSteps::toolpath ? 1 : 0;
}

}  // namespace

double program_effort(const Setup& setup) {
    constexpr double mm3_per_litre = 1e6;
    constexpr double mm2_per_dm2 = 1e4;
    const Vec3 size = setup.milled_box().size();
    const double litres = std::max(least, size.x * size.y * size.z / mm3_per_litre);
    const double dm2 = std::max(least, setup.access.area_mm2 / mm2_per_dm2);
    const auto orientations = static_cast<double>(setup.access.orientations.size());
    return seconds * std::pow(litres, by_volume) * std::pow(dm2, by_area) * std::pow(orientations, by_orientations);
}

std::string describe(const std::vector<PlannedProgram>& programs) {
    double all = 0;
    for (const PlannedProgram& program : programs) all += program.effort;
    std::string text = programs.size() > 1 ? "programs to make, the largest first: " : "program to make: ";
    for (std::size_t i = 0; i < std::min(named, programs.size()); ++i) {
        const std::string percent = fixed(100 * programs[i].effort / all, 0) + " %";
        if (i > 0) text += ", ";
        text += programs[i].piece;
        if (programs.size() > 1) text += i == 0 ? " (estimated at " + percent + " of the work)" : " (" + percent + ")";
    }
    if (programs.size() > named) text += " and " + std::to_string(programs.size() - named) + " more";
    return text;
}

double rest_of_work(std::vector<double> begun, const std::vector<double>& waiting) {
    if (begun.empty()) begun.push_back(0);
    for (const double item : waiting) *std::ranges::min_element(begun) += item;
    return *std::ranges::max_element(begun);
}

ProgramProgress::ProgramProgress(const Context& context, const std::vector<PlannedProgram>& programs,
                                 ProgramSteps steps)
    : context_(context),
      toolpath_share_(toolpath_share(steps)),
      what_("% of the time for " + counted(programs.size(), steps == ProgramSteps::toolpath ? "toolpath" : "program")),
      started_(Clock::now()) {
    for (const PlannedProgram& program : programs) items_.emplace_back().effort = program.effort;
    if (!items_.empty()) context_.progress(what_, 0, 100);
}

Context ProgramProgress::of(std::size_t index, const Context& context) {
    Context own = context;
    own.on_progress = [this, index](const Progress& step) {
        const std::lock_guard lock(mutex_);
        take(items_[index], step);
        report();
    };
    const std::lock_guard lock(mutex_);
    items_[index].is_begun = true;
    items_[index].begun = Clock::now();
    return own;
}

void ProgramProgress::finish(std::size_t index) {
    const std::lock_guard lock(mutex_);
    Item& item = items_[index];
    item.is_begun = item.is_done = true;
    item.done = 1;
    item.seconds = std::chrono::duration<double>(Clock::now() - item.begun).count();
    report();
}

void ProgramProgress::take(Item& item, const Progress& step) {
    double done = 0;
    if (step.what == toolpath_step.what) done = toolpath_share_ * at(toolpath_step, step);
    if (step.what == parts_step) {
        item.before = done = toolpath_share_ + (1 - toolpath_share_) * item.read;
        item.of_part = (1 - toolpath_share_) * (ratio(step) - item.read);
        item.read = ratio(step);
    }
    const auto proof = std::ranges::find(proof_steps, step.what, &Step::what);
    if (proof != proof_steps.end()) done = item.before + item.of_part * at(*proof, step);
    item.done = std::max(item.done, std::min(done, 1.0));
}

double ProgramProgress::share(Clock::time_point now) {
    const std::lock_guard lock(mutex_);
    return share_now(now);
}

double ProgramProgress::share_now(Clock::time_point now) const {
    const auto since = [&](Clock::time_point then) { return std::chrono::duration<double>(now - then).count(); };
    double done = 0;
    double busy_s = 0;
    std::vector<double> begun;
    std::vector<double> waiting;
    for (const Item& item : items_) {
        done += item.effort * item.done;
        if (item.is_begun) busy_s += item.is_done ? item.seconds : since(item.begun);
        if (item.is_begun && !item.is_done) begun.push_back(item.effort * (1 - item.done));
        if (!item.is_begun) waiting.push_back(item.effort);
    }
    if (begun.empty() && waiting.empty()) return 1;
    if (!(done > 0) || !(busy_s > 0)) return 0;
    const double left_s = rest_of_work(begun, waiting) * busy_s / done;
    const double elapsed_s = since(started_);
    return elapsed_s / (elapsed_s + left_s);
}

// Never less than before: callers take that for other work.
void ProgramProgress::report() {
    percent_ = std::max(percent_, static_cast<std::size_t>(100 * share_now(Clock::now())));
    context_.progress(what_, percent_, 100);
}

}  // namespace qchopper
