// Reads a scan from a file as it stands: nothing is welded, shifted or scaled. PLY, STL, OBJ, OFF, glTF, GLB and 3MF.
//
// Coordinates are in the file's own unit with Z up; docs/formats.md says what is read of each format. The format is
// told by the content, never by the name. Whatever the bytes, the answer is a mesh with finite coordinates and valid
// indices or an InputError (mesh) that says what is wrong and at which line or byte
// (tests/segment/io/read_mesh_test.cpp, tests/segment/io/damaged_test.cpp).

#pragma once

#include <filesystem>
#include <string>

#include "base/file.h"
#include "segment/io/raw_mesh.h"

namespace qchopper {

// The bytes of a scan; "-" is standard input, to its end. Throws InputError (missing) if they cannot be read.
Bytes read_scan(const std::filesystem::path& path);

// Throws InputError (missing) for a file that cannot be read, (mesh) for one that is wrong.
RawMesh read_mesh(const std::filesystem::path& path, const ReadOptions& options = {});

// The same from bytes in memory; `name` stands for the file in errors. Only a glTF file looks for others, in `folder`;
// without a folder it is refused if it has any.
RawMesh parse_mesh(const Bytes& bytes, const std::string& name, const std::filesystem::path& folder = {},
                   const ReadOptions& options = {});

// The name and the folder to give to parse_mesh for the file at `path`.
std::string name_of_scan(const std::filesystem::path& path);
std::filesystem::path folder_of(const std::filesystem::path& path);

}  // namespace qchopper
