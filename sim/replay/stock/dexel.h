// A part of a line.

#pragma once

namespace qchopper {

// mm along the line.
struct Dexel {
    double low = 0;
    double high = 0;
};

}  // namespace qchopper
