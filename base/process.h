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

// From now on memory that is freed is kept for what is allocated next, and not given back to the system; the first 1.5
// GB come in large pages where the system has them. For a program that takes and frees large blocks again and again:
// each time the system would clear their pages anew. Needs glibc, and does nothing without it. No thread may allocate
// meanwhile.
void keep_freed_memory();

// Gives back to the system what has been freed and kept, if more than so many bytes of the process are resident:
// between two kinds of work that need blocks of other sizes. Each page that is needed again is cleared anew. Needs
// glibc and Linux, and does nothing without them. O(memory of the process).
void give_back_freed_memory(std::size_t resident = 1'000'000'000);

// CPU time of this process so far, in seconds.
double cpu_seconds();

}  // namespace qchopper
