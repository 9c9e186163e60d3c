// Reads every file again, so that runs made at different times are printed together.

#include "bench/carve_summary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <ostream>

#include "base/text.h"
#include "bench/carve_runs.h"

namespace qchopper::bench {
namespace {

constexpr std::array<std::size_t, 6> shown_cuts{0, 1, 2, 4, 8, 16};
constexpr double small_share = 0.005;     // both below: the aim holds
constexpr double aimed_ratio = 0.5;       // of the thesis' share
constexpr std::size_t compared_cuts = 8;  // of the thesis
constexpr std::size_t aimed_cuts = 4;     // to reach its share then

std::string percent(double share) {
    return fixed(100 * share, share < 0.01 ? 2 : 1);
}

const CarveState* after(const CarveRun& run, std::size_t cuts) {
    const auto state =
        std::find_if(run.states.begin(), run.states.end(), [&](const CarveState& s) { return s.cuts == cuts; });
    return state == run.states.end() ? nullptr : &*state;
}

// The last state with no more pieces. The uncut scan, if every cut makes more.
const CarveState* with_pieces(const CarveRun& run, std::size_t pieces) {
    const CarveState* best = nullptr;
    for (const CarveState& s : run.states) {
        if (s.pieces <= pieces) best = &s;
    }
    return best;
}

std::vector<CarveRun> runs_of(const std::filesystem::path& folder, const std::vector<std::string>& models,
                              const std::string& method, int tilt) {
    std::vector<CarveRun> runs;
    for (const std::string& model : models) {
        runs.push_back(read_run(folder, {model, method, tilt, {}, 0, 0}));
        if (runs.back().max_cuts == 0) runs.back().states.clear();
    }
    return runs;
}

void print_shares(const std::filesystem::path& folder, const std::vector<std::string>& models, int tilt,
                  std::ostream& out) {
    out << "\n### " << tilt << " degrees\n\n| model | cuts |";
    for (const std::string& method : carve_methods) out << " " << method << " |";
    out << "\n|---|---|---|---|---|\n";
    std::vector<std::vector<CarveRun>> runs;
    runs.reserve(carve_methods.size());
    for (const std::string& method : carve_methods) runs.push_back(runs_of(folder, models, method, tilt));
    for (std::size_t m = 0; m < models.size(); ++m) {
        for (const std::size_t cuts : shown_cuts) {
            out << "| " << models[m] << " | " << cuts << " |";
            for (const std::vector<CarveRun>& of_method : runs) {
                const CarveState* s = after(of_method[m], cuts);
                out << " ";
                if (s != nullptr) {
                    out << s->pieces << ": " << percent(s->measured) << " / " << percent(s->predicted) << " ("
                        << percent(s->worst) << ")";
                }
                out << " |";
            }
            out << "\n";
        }
    }
}

struct Compared {
    std::string text;
    std::optional<bool> holds;
};

// At the pieces that the thesis has after so many cuts.
Compared compared_at(const CarveRun& thesis, const CarveRun& carve, std::size_t cuts) {
    const CarveState* t = after(thesis, cuts);
    const CarveState* c = t == nullptr ? nullptr : with_pieces(carve, t->pieces);
    if (c == nullptr || (c == &carve.states.back() && c->cuts < cuts && c->pieces < t->pieces)) return {};
    const bool are_small = t->measured < small_share && c->measured < small_share;
    const bool holds = are_small || c->measured <= aimed_ratio * t->measured;
    const std::string ratio = t->measured > 0 ? " = " + fixed(c->measured / t->measured, 2) : "";
    return {percent(c->measured) + " (" + counted(c->cuts, "cut") + ") / " + percent(t->measured) + ratio +
                (holds ? "" : " **no**"),
            holds};
}

// How many cuts of carve leave no more than the thesis' eight.
Compared cuts_to_reach(const CarveRun& thesis, const CarveRun& carve) {
    const CarveState* t = after(thesis, compared_cuts);
    if (t == nullptr || carve.states.empty()) return {};
    const auto s = std::find_if(carve.states.begin(), carve.states.end(),
                                [&](const CarveState& state) { return state.measured <= t->measured; });
    if (s == carve.states.end()) {
        return {"more than " + std::to_string(carve.states.back().cuts) + " **no**", false};
    }
    const bool holds = s->cuts <= aimed_cuts;
    return {std::to_string(s->cuts) + (holds ? "" : " **no**"), holds};
}

class Tally {
 public:
    void add(const Compared& c) {
        held_ += c.holds.value_or(false) ? 1 : 0;
        known_ += c.holds ? 1 : 0;
    }
    std::string text() const { return std::to_string(held_) + " of " + std::to_string(known_); }

 private:
    int held_ = 0;
    int known_ = 0;
};

void print_aims(const std::filesystem::path& folder, const std::vector<std::string>& models, int tilt,
                const std::string& method, std::ostream& out) {
    const std::vector<CarveRun> thesis = runs_of(folder, models, "thesis", tilt);
    const std::vector<CarveRun> carve = runs_of(folder, models, method, tilt);
    const bool is_any = std::any_of(carve.begin(), carve.end(), [](const CarveRun& r) { return !r.states.empty(); });
    if (!is_any) return;
    out << "\n" << method << " / thesis at " << tilt << " degrees, at equal piece count:\n\n| model |";
    for (const std::size_t cuts : shown_cuts) {
        if (cuts > 0) out << " thesis' " << counted(cuts, "cut") << " |";
    }
    out << " cuts to reach its " << compared_cuts << " |\n|---|---|---|---|---|---|---|\n";
    std::array<Tally, shown_cuts.size()> held;  // the last one: cuts to reach
    for (std::size_t m = 0; m < models.size(); ++m) {
        out << "| " << models[m] << " |";
        for (std::size_t i = 1; i < shown_cuts.size(); ++i) {
            const Compared c = compared_at(thesis[m], carve[m], shown_cuts[i]);
            held[i - 1].add(c);
            out << " " << c.text << " |";
        }
        const Compared c = cuts_to_reach(thesis[m], carve[m]);
        held.back().add(c);
        out << " " << c.text << " |\n";
    }
    out << "| the aim holds on |";
    for (const Tally& tally : held) out << " " << tally.text() << " |";
    out << "\n";
}

// Predicted less measured, in points.
struct Errors {
    double sum = 0;
    double absolute = 0;
    double largest = 0;
    std::string where;
    std::size_t count = 0;

    void add(double error, const std::string& at) {
        sum += error;
        absolute += std::abs(error);
        ++count;
        if (std::abs(error) <= std::abs(largest)) return;
        largest = error;
        where = at;
    }
    std::string text() const {
        if (count == 0) return "";
        const auto n = static_cast<double>(count);
        return fixed(sum / n, 2) + " | " + fixed(absolute / n, 2) + " | " + fixed(largest, 2) + ", " + where;
    }
};

void print_errors(const std::filesystem::path& folder, const std::vector<std::string>& models,
                  const std::vector<int>& tilts, std::ostream& out) {
    out << "\n### Predicted less measured\n\n"
           "| tilt | method | what | states | mean | mean size | largest |\n|---|---|---|---|---|---|---|\n";
    for (const int tilt : tilts) {
        for (const std::string& method : carve_methods) {
            Errors predicted;
            Errors on_samples;
            for (const CarveRun& run : runs_of(folder, models, method, tilt)) {
                for (const CarveState& s : run.states) {
                    const std::string at = run.model + " after " + counted(s.cuts, "cut");
                    predicted.add(100 * (s.predicted - s.measured), at);
                    on_samples.add(100 * (s.on_samples - s.measured), at);
                }
            }
            for (const auto& [what, errors] : {std::pair{"predicted", &predicted}, {"after the cut", &on_samples}}) {
                if (errors->count == 0 || (errors == &on_samples && method == "thesis")) continue;  // the same
                out << "| " << tilt << " | " << method << " | " << what << " | " << errors->count << " | "
                    << errors->text() << " |\n";
            }
        }
    }
}

}  // namespace

void print_carve(const std::filesystem::path& folder, const std::vector<std::string>& models,
                 const std::vector<int>& tilts, std::ostream& out) {
    for (const int tilt : tilts) {
        print_shares(folder, models, tilt, out);
        for (std::size_t m = 1; m < carve_methods.size(); ++m) print_aims(folder, models, tilt, carve_methods[m], out);
    }
    print_errors(folder, models, tilts, out);
}

}  // namespace qchopper::bench
