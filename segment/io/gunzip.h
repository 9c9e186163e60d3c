// Unpacks what came compressed by gzip, and says how much any packed file may become.
//
// A file of a few kilobytes can be made that unpacks to a hundred gigabytes; it is refused before it takes the memory
// (tests/segment/io/unpack_test.cpp).

#pragma once

#include <cstdint>
#include <string>

#include "base/file.h"

namespace qchopper {

// The most bytes that packed ones may become: 200 times as many (scans shrink to a twentieth at most), at least 64 MiB
// and at most 8 GiB.
std::uint64_t most_unpacked(std::uint64_t packed);

bool is_gzip(const Bytes& bytes);

// All members of the file one after the other. Throws InputError (mesh) for one that is damaged, cut short or too
// large.
Bytes gunzip(const Bytes& bytes, const std::string& name);

}  // namespace qchopper
