// Writes named bytes as a ZIP in memory, the same for the same content, and reads job files back.
//
// Entries are dated 1980-01-01. Stored ones have the same bytes everywhere; those of packed ones may differ, never
// their content, where another version of zlib packs them (tests/base/files/zip_test.cpp). What unzip returns never
// exceeds its input in size (tests/base/files/unzip_test.cpp).

#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/files/file.h"

namespace qchopper {

// Appends the next stretch of an entry to an empty string; leaves it empty at the end.
using NextStretch = std::function<void(std::string& stretch)>;

struct ZipEntry {
    std::string name;
    std::function<NextStretch()> open;  // called once per reading, of which there are two: an entry may exceed memory
    bool is_packed = false;             // by deflate; otherwise stored
    std::function<void()> close = {};   // called after the last reading; may be empty
};

// An entry of bytes in memory, stored. `bytes` must outlive it.
ZipEntry zip_entry(std::string name, const Bytes& bytes);

// The entries in the order given. Names are different, and no `open` is empty. Throws what an entry throws.
Bytes zip(const std::vector<ZipEntry>& entries);

// The files by name, sorted and stored, so that neither the version of a compressor nor a cell without one matters.
// The second releases each file when it is packed, so that the archive and the files are not in memory together.
Bytes zip(const std::map<std::string, Bytes>& files);
Bytes zip(std::map<std::string, Bytes>&& files);

// The files of a ZIP that is, byte for byte, what zip(files) writes. Throws InputError (mesh) naming `source`, the job
// file, if it is cut short, damaged, compressed, in another order, has anything before, between or behind its entries,
// or a name that is not portable (is_portable_name).
std::map<std::string, Bytes> unzip(const Bytes& bytes, const std::string& source);

}  // namespace qchopper
