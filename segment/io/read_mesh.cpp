// Unpacks gzip, converts to UTF-8, and calls the reader whose mark the bytes bear. The readers state their cost.

#include "segment/io/read_mesh.h"

#include "base/error.h"
#include "segment/io/glb_file.h"
#include "segment/io/gunzip.h"
#include "segment/io/read_3mf.h"
#include "segment/io/read_gltf.h"
#include "segment/io/read_obj.h"
#include "segment/io/read_off.h"
#include "segment/io/read_ply.h"
#include "segment/io/read_stl.h"
#include "segment/io/to_utf8.h"

namespace qchopper {
namespace {

[[noreturn]] void refuse_unknown(const Bytes& bytes, const std::string& name) {
    throw InputError(InputFault::mesh,
                     name + " does not begin like a " + mesh_formats + " file, and " + why_no_binary_stl(bytes),
                     "give a file of one of these formats; if it was one, export or copy it again");
}

// OBJ comes last: its only mark is the first word of its first line.
RawMesh parse_by_content(const Bytes& bytes, const std::string& name, const std::filesystem::path& folder) {
    if (is_ply(bytes)) return parse_ply(bytes, name);
    if (is_ascii_stl(bytes)) return parse_ascii_stl(bytes, name);
    if (is_glb(bytes) || is_gltf(bytes)) return parse_gltf(bytes, name, folder);
    if (is_3mf(bytes)) return parse_3mf(bytes, name);
    if (is_off(bytes)) return parse_off(bytes, name);
    if (is_obj(bytes)) return parse_obj(bytes, name);
    refuse_unknown(bytes, name);
}

// After unpacking. A binary STL comes first: its length is a better mark than the first bytes.
RawMesh parse_unpacked(const Bytes& bytes, const std::string& name, const std::filesystem::path& folder,
                       const ReadOptions& options) {
    if (is_binary_stl(bytes)) return parse_binary_stl(bytes, name, options.weld);
    if (const std::optional<Bytes> text = to_utf8(bytes)) return parse_by_content(*text, name, folder);
    return parse_by_content(bytes, name, folder);
}

RawMesh parse_packed(const Bytes& bytes, const std::string& name, const std::filesystem::path& folder,
                     const ReadOptions& options) {
    if (bytes.empty()) throw InputError(InputFault::mesh, name + " is empty", "export or copy the file again");
    if (!is_gzip(bytes) || is_binary_stl(bytes)) return parse_unpacked(bytes, name, folder, options);
    const Bytes unpacked = gunzip(bytes, name);
    if (unpacked.empty()) throw InputError(InputFault::mesh, name + " is empty after unpacking", "copy the file again");
    return parse_unpacked(unpacked, name, folder, options);
}

}  // namespace

RawMesh parse_mesh(const Bytes& bytes, const std::string& name, const std::filesystem::path& folder,
                   const ReadOptions& options) {
    RawMesh scan = parse_packed(bytes, name, folder, options);
    if (scan.mesh.triangles.empty()) {
        throw InputError(InputFault::mesh, name + " holds no faces", "export the scan as a surface, not as points");
    }
    return scan;
}

Bytes read_scan(const std::filesystem::path& path) {
    return path == "-" || path == "/dev/stdin" ? read_standard_input() : read_file(path);
}

RawMesh read_mesh(const std::filesystem::path& path, const ReadOptions& options) {
    return parse_mesh(read_scan(path), name_of_scan(path), folder_of(path), options);
}

std::string name_of_scan(const std::filesystem::path& path) {
    return path == "-" ? "standard input" : path.string();
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
    if (path == "-") return {};
    return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

}  // namespace qchopper
