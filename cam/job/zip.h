// A ZIP of named bytes in memory that is the same for the same content, and the way back for bytes from anywhere.
//
// Entries are sorted by name, stored without compression (so that neither the compressor's version nor a cell without
// one matters), dated 1980-01-01. What unzip returns never exceeds the input in size
// (tests/cam/job/zip_test.cpp).

#pragma once

#include <map>
#include <string>

#include "base/file.h"

namespace qchopper {

Bytes zip(const std::map<std::string, Bytes>& files);

// Takes only what zip() writes, to the last byte. Throws InputError (mesh) naming `source` if it is cut short, damaged,
// compressed, in another order, followed by anything, or holds a name that is not plain (is_portable_name).
std::map<std::string, Bytes> unzip(const Bytes& bytes, const std::string& source);

}  // namespace qchopper
