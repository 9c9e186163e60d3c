// Where an axis of a plot gets its numbers (tests/segment/picture/plot_test.cpp).

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
    std::vector<double> values;  // ascending, inside the range
    int decimals = 0;
    bool is_logarithmic = false;  // then every number gets the decimals that it needs
    std::string text(double value) const;
};

// Round numbers, about as many as wanted. The range must be wide enough: mended().
Ticks ticks(PlotRange range, int wanted);

// Powers of ten, and 2 and 5 times them where there is room. The range must be positive.
Ticks decades(PlotRange range);

// The range itself, or one near it that can be drawn: finite, and wide enough to divide by.
PlotRange mended(PlotRange range);

}  // namespace qchopper
