#include "tests/fuzz/cell_steps.h"

// What a simulated cell is sent, request by request (cell_steps.h).
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    qchopper::Input input(data, size);
    qchopper::CellSteps cell;
    cell.run(input);
    return 0;
}
