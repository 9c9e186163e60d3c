// Unpacks gzip files, and limits how many bytes any packed file may unpack to.
//
// A file of a few kilobytes can unpack to a hundred gigabytes; it is refused before that memory is taken
// (tests/segment/io/formats/unpack_test.cpp).

#pragma once

#include <cstdint>
#include <string>

#include "base/files/file.h"

namespace qchopper {

// The most bytes that so many packed bytes may unpack to: 200 times as many (scans shrink to a twentieth at most), at
// least 64 MiB and at most 8 GiB.
std::uint64_t max_unpacked(std::uint64_t packed);

// Whether the bytes begin with the marks of gzip and of deflate, its only method.
bool is_gzip(const Bytes& bytes);

// The contents of all members, one after the other. Precondition: is_gzip(bytes). Throws InputError (mesh) if a member
// is damaged or cut short, or if they unpack to more than max_unpacked(bytes.size()); `name` stands for the file.
Bytes gunzip(const Bytes& bytes, const std::string& name);

}  // namespace qchopper
