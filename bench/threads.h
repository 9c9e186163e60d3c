// Limits all parallel work to so many threads while it lives. Of two that live the lower holds, so they never nest.

#pragma once

#include <tbb/global_control.h>

#include <cstddef>

namespace qchopper::bench {

class Threads {
 public:
    explicit Threads(std::size_t count) : control_(tbb::global_control::max_allowed_parallelism, count) {}

 private:
    tbb::global_control control_;
};

}  // namespace qchopper::bench
