// Stretches of a pass that hold a condition, and the pass without them.
//
// Lengths in mm from the beginning of the pass.

#pragma once

#include <cstddef>
#include <vector>

#include "base/vec3.h"
#include "cam/toolpath/pass.h"

namespace qchopper {

constexpr double min_part = 2;  // mm of a part of a pass that is worth a way there

struct Stretch {
    double from = 0;
    double to = 0;
};

double length_of(const Pass& pass);
double length_of(const std::vector<Pass>& passes);

// Where the tip may not be, asked at most so far apart; the line to such a point belongs to it. In order, none touches
// another. Calls is_free(Vec3 tip). Precondition: the pass has points.
template <class IsFree>
std::vector<Stretch> blocked_stretches(const Pass& pass, double apart, const IsFree& is_free) {
    std::vector<Stretch> blocked;
    bool was_free = is_free(pass.points[0].tip);
    if (!was_free) blocked.push_back({});
    double begin = 0;
    double before = 0;
    for (std::size_t i = 1; i < pass.points.size(); ++i) {
        const Vec3 from = pass.points[i - 1].tip;
        const Vec3 way = pass.points[i].tip - from;
        const double length = norm(way);
        const auto samples = static_cast<std::size_t>(length / apart) + 1;
        for (std::size_t k = 1; k <= samples; ++k) {
            const double share = static_cast<double>(k) / static_cast<double>(samples);
            const bool now_free = is_free(from + share * way);
            const double at = begin + share * length;
            if (was_free && !now_free) blocked.push_back({before, at});
            if (!was_free) blocked.back().to = at;
            was_free = now_free;
            before = at;
        }
        begin += length;
    }
    return blocked;
}

// Cuts stretches out of a pass, one after the other.
class PassCutter {
 public:
    // The pass must outlive it.
    explicit PassCutter(const Pass& pass) : pass_(pass) {}

    // From where the one before has ended to so far from the beginning of the pass. Corners at its ends are not
    // rounded.
    Pass up_to(double end);

 private:
    const Pass& pass_;
    double at_ = 0;
    std::size_t next_ = 1;
    PassPoint here_ = pass_.points[0];
};

constexpr double min_length = 1e-6;  // mm; a part that is shorter comes from rounding

}  // namespace qchopper
