// What is done to the bytes of a file before a reader gets them: gzip is unpacked, and UTF-16 becomes bytes.
//
// A packed file of a few kilobytes can unpack to a hundred gigabytes; it is refused before that memory is taken. Some
// programs on Windows save OBJ and PLY as UTF-16. All that describes a mesh is ASCII; other characters occur in names
// and comments only and become question marks (tests/segment/io/formats/unpack_test.cpp).

#pragma once

#include <cstdint>
#include <optional>
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

// Nothing if the bytes begin with no byte order mark: they need no conversion.
std::optional<Bytes> to_utf8(const Bytes& bytes);

}  // namespace qchopper
