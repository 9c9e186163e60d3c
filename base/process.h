// The machine and the process that this is, and other processes of the machine.

#pragma once

#include <cstddef>
#include <string>

namespace qchopper {

// Of the machine, as a part of a file name: at most 24 letters, digits and hyphens.
std::string host_name();

// The first argument of this process, as its caller gave it; empty without one.
std::string first_argument();

// Whether there is no process of that number on this machine.
bool has_process_ended(long process);

// Resident memory of this process at its peak so far, in bytes.
std::size_t peak_memory();

// From now on memory that is freed is kept for what is allocated next, and not given back to the system. For a program
// that takes and frees large blocks again and again: each time the system would clear their pages anew. Needs glibc,
// and does nothing without it. No thread may allocate meanwhile.
void keep_freed_memory();

// CPU time of this process so far, in seconds.
double cpu_seconds();

}  // namespace qchopper
