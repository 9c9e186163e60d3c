// Entry point.

#include "app/cli/run.h"

int main(int argc, char** argv) {
    return qchopper::run_program(argc, argv);
}
