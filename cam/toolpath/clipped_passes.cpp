// A pass is looked at in samples half a cell of the foam's map apart. O(length / cell * (radius / cell)^2).

#include "cam/toolpath/clipped_passes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cam/toolpath/disc_max.h"

namespace qchopper {
namespace {

constexpr double least_free = 2;  // mm of a part of a pass that is worth a way there
constexpr double touching = 1.5;  // mm

// Collects the points of a pass into parts that are free and parts that are blocked.
class PassParts {
 public:
    explicit PassParts(ClippedPasses& parts) : parts_(parts) {}

    // A further point, and whether the tip may be there. The line to a blocked point is blocked.
    void add(const PassPoint& point, bool is_free) {
        if (!points_.empty() && is_free != is_free_) {
            const PassPoint last = points_.back();
            if (is_free) points_.push_back({point.tip, false});
            end_part();
            if (!is_free) points_.push_back({last.tip, false});
        }
        is_free_ = is_free;
        points_.push_back(point);
    }

    void end_pass(bool is_closed) {
        is_closed_ = is_closed && is_whole_;
        end_part();
    }

 private:
    void end_part() {
        if (points_.size() >= 2) {
            Pass part{std::move(points_), is_closed_};
            const bool is_long = is_closed_ || length_of(part) >= least_free;
            (is_free_ && is_long ? parts_.free : parts_.blocked).push_back(std::move(part));
        }
        points_.clear();
        is_whole_ = false;
    }

    ClippedPasses& parts_;
    std::vector<PassPoint> points_;
    bool is_free_ = true;
    bool is_whole_ = true;
    bool is_closed_ = false;
};

// By whether the tip may be at a point, asked at most so far apart.
template <class IsFree>
ClippedPasses divided(const std::vector<Pass>& passes, double apart, const IsFree& is_free) {
    ClippedPasses parts;
    for (const Pass& pass : passes) {
        PassParts own(parts);
        bool was_free = is_free(pass.points[0].tip);
        own.add(pass.points[0], was_free);
        for (std::size_t i = 1; i < pass.points.size(); ++i) {
            const Vec3 from = pass.points[i - 1].tip;
            const PassPoint& point = pass.points[i];
            const auto samples = static_cast<std::size_t>(norm(point.tip - from) / apart) + 1;
            Vec3 before = from;
            for (std::size_t k = 1; k <= samples; ++k) {
                const Vec3 p = from + (static_cast<double>(k) / static_cast<double>(samples)) * (point.tip - from);
                const bool now_free = is_free(p);
                // The point before the change, so that a line has samples of one kind.
                if (now_free != was_free) {
                    if (k > 1) own.add({before, false}, was_free);
                    if (k < samples) own.add({p, false}, now_free);
                }
                was_free = now_free;
                before = p;
            }
            own.add(point, was_free);
        }
        own.end_pass(pass.is_closed);
    }
    return parts;
}

}  // namespace

double length_of(const std::vector<Pass>& passes) {
    double length = 0;
    for (const Pass& pass : passes) length += length_of(pass);
    return length;
}

ClippedPasses clipped(const std::vector<Pass>& passes, const CarvingSpace& space, const CarvingTool& tool) {
    const double inner = std::max(0.0, 0.5 * tool.diameter - flute_rim);
    return divided(passes, 0.5 * space.foam.cell, [&](Vec3 p) {
        return least_height(space.holder_limit, p.x, p.y) <= p.z &&
               static_cast<double>(disc_max_at(space.middle_foam, p.x, p.y, inner)) <= p.z + tool.flute_length;
    });
}

std::vector<Pass> near_surface(const std::vector<Pass>& passes, const HeightMap& tip) {
    return divided(passes, touching,
                   [&](Vec3 p) { return static_cast<double>(disc_max_at(tip, p.x, p.y, touching)) >= p.z - touching; })
        .free;
}

}  // namespace qchopper
