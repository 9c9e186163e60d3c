// O(points).

#include "cam/toolpath/pass_stretches.h"

namespace qchopper {

double length_of(const Pass& pass) {
    double length = 0;
    for (std::size_t i = 1; i < pass.points.size(); ++i) length += norm(pass.points[i].tip - pass.points[i - 1].tip);
    return length;
}

double length_of(const std::vector<Pass>& passes) {
    double length = 0;
    for (const Pass& pass : passes) length += length_of(pass);
    return length;
}

Pass PassCutter::up_to(double end) {
    Pass part;
    part.points.push_back(here_);
    while (next_ < pass_.points.size()) {
        const PassPoint& point = pass_.points[next_];
        const double length = norm(point.tip - here_.tip);
        if (at_ + length > end) {
            here_ = {here_.tip + ((end - at_) / length) * (point.tip - here_.tip), false};
            break;
        }
        at_ += length;
        here_ = point;
        ++next_;
        part.points.push_back(point);
    }
    if (norm(here_.tip - part.points.back().tip) > min_length) part.points.push_back(here_);
    at_ = end;
    here_.is_rounded = false;
    part.points.back().is_rounded = false;
    return part;
}

}  // namespace qchopper
