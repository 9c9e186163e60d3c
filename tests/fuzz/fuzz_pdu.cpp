// Requests to the simulated cell, one after the other (cell_steps.h).

#include "tests/fuzz/cell_steps.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    qchopper::Input input(data, size);
    qchopper::CellSteps cell;
    cell.run(input);
    return 0;
}
