// Chooses the numbers at an axis of a plot (tests/segment/picture/plot_test.cpp).

#pragma once

#include <string>
#include <vector>

namespace qchopper {

struct PlotRange {
    double low = 0;
    double high = 1;
    bool operator==(const PlotRange&) const = default;
};

struct Ticks {
    std::vector<double> values;   // ascending, inside the range up to rounding
    int decimals = 0;             // 0 to 12
    bool is_logarithmic = false;  // then each number has as many decimals as it needs, at most `decimals`
    std::string text(double value) const;
};

// Round numbers, about as many as wanted. Preconditions: wanted > 0, and the range is a drawable_range().
Ticks ticks(PlotRange range, int wanted);

// Powers of ten, and 2 and 5 times them in a range of less than one and a half decades. Precondition: 0 < low < high.
Ticks decades(PlotRange range);

// The range itself if it is finite and wide enough to divide by its width, else a wider one around it; 0 to 1 for a
// range that is not finite or is reversed.
PlotRange drawable_range(PlotRange range);

}  // namespace qchopper
