// A ZIP of named bytes in memory that is the same for the same content.
//
// Entries stand in the order given, dated 1980-01-01. Stored ones come out the same everywhere; packed ones may differ
// in their bytes, never in their content, where another version of zlib packs them (tests/base/zip_test.cpp).

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/file.h"

namespace qchopper {

// Appends the next stretch of an entry to an empty string; leaves it empty at the end.
using NextStretch = std::function<void(std::string& stretch)>;

struct ZipEntry {
    std::string name;
    std::function<NextStretch()> open;  // called anew for every reading; what is large never lies in memory whole
    bool is_packed = false;             // by deflate; otherwise stored as it is
};

// An entry whose bytes are there already. They stay the caller's.
ZipEntry zip_entry(std::string name, const Bytes& bytes);

Bytes zip(const std::vector<ZipEntry>& entries);

}  // namespace qchopper
