// Reads a scan from a PLY, STL, OBJ, OFF, glTF, GLB or 3MF file as it stands: nothing is welded, shifted or scaled.
//
// Coordinates are in the unit of the file with Z up; docs/user/scan-formats.md lists what is read of each format. The
// content determines the format; the ending of the name counts only where it bears the marks of several. For all bytes
// the result is a mesh with finite coordinates and valid indices, or an InputError (mesh) that states what is wrong and
// at which line or byte (tests/segment/io/read_mesh_test.cpp, tests/segment/io/damaged_test.cpp).

#pragma once

#include <filesystem>
#include <string>

#include "base/files/file.h"
#include "segment/io/formats/raw_mesh.h"

namespace qchopper {

// The bytes of a scan; "-" and "/dev/stdin" are standard input, to its end. Throws InputError (missing) if they cannot
// be read, (mesh) if they are more than scan_limit.
Bytes read_scan(const std::filesystem::path& path);

// Throws as read_scan and parse_mesh do.
RawMesh read_mesh(const std::filesystem::path& path, const ReadOptions& options = {});

// The same from bytes in memory; `name` stands for the file in messages. Only a glTF file names others, which are read
// from `folder`; with an empty folder it is refused if it names any. Throws InputError (mesh) for a file that is
// damaged or holds no faces, (missing) for a file beside it that cannot be read.
RawMesh parse_mesh(const Bytes& bytes, const std::string& name, const std::filesystem::path& folder = {},
                   const ReadOptions& options = {});

// The name and the folder to give to parse_mesh for the file at `path`; of "-" the folder is empty.
std::string name_of_scan(const std::filesystem::path& path);
std::filesystem::path folder_of(const std::filesystem::path& path);

}  // namespace qchopper
