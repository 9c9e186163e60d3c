// Latency of the simulated cell during attacks, beside a bare server with poll() that sends back what it gets, under
// the same attacks in the same run; and the transfer of a file in chunks beside a loop of libmodbus.

#pragma once

#include "bench/figures.h"

namespace qchopper::bench {

// Each attack of tests/sim/cell/attackers.h by 50 hostile clients, `seconds` long at each of the two servers.
void measure_attacks(double seconds, Figures& figures);

// Bytes per second of a libmodbus client that writes 232 bytes a request (FC16) to a libmodbus server, over loopback.
double libmodbus_bytes_per_s();

}  // namespace qchopper::bench
