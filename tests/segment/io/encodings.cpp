#include "tests/segment/io/encodings.h"

#include <limits>

#include "segment/io/write_3mf.h"
#include "segment/io/write_glb.h"
#include "segment/io/write_mesh.h"
#include "tests/segment/io/help.h"
#include "tests/segment/io/wrappings.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

constexpr std::size_t whole_lines = std::numeric_limits<std::size_t>::max();  // nothing tells that lines are missing

// The same as to_ply, in the other order.
Bytes big_endian_ply(const TriangleMesh& mesh) {
    const Bytes little = to_ply(mesh);
    std::string header(little.begin(), little.end());
    header.resize(header.find("end_header\n") + 11);
    std::size_t at = header.size();
    header.replace(header.find("little"), 6, "big");
    Bytes big(header.begin(), header.end());
    const auto copy_turned = [&](std::size_t size) {
        for (std::size_t i = size; i-- > 0;) big.push_back(little[at + i]);
        at += size;
    };
    for (std::size_t i = 0; i < 3 * mesh.points.size(); ++i) copy_turned(8);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        copy_turned(1);
        for (int i = 0; i < 3; ++i) copy_turned(4);
        if (!mesh.cap_of.empty()) copy_turned(4);
    }
    return big;
}

// Faces before the points, with an element and properties that nobody asked for.
std::string odd_ply(const TriangleMesh& mesh) {
    const std::string faces = std::to_string(mesh.triangles.size());
    std::string text =
        "ply\nformat ascii 1.0\nobj_info odd\nelement camera 1\nproperty list uchar short view\n"
        "element face " +
        faces + "\nproperty int cap\nproperty list int uint vertex_index\nelement vertex " +
        std::to_string(mesh.points.size()) +
        "\nproperty uchar red\nproperty float z\nproperty float y\nproperty float x\nend_header\n2 7 8\n";
    for (const Triangle& t : mesh.triangles) {
        text += "-1 3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
    }
    for (const Vec3& p : mesh.points) {
        text += "255 " + std::to_string(p.z) + " " + std::to_string(p.y) + " " + std::to_string(p.x) + "\n";
    }
    return text;
}

// Every triangle is a strip, and all strips are one list.
std::string strips_ply(const TriangleMesh& mesh) {
    std::string text = ascii_ply(mesh);
    const std::size_t element = text.find("element face");
    text.resize(text.find("\n3 ", element) + 1);
    text.replace(element, text.find('\n', element) - element, "element tristrips 1");
    const std::size_t list = text.find("list uchar");
    text.replace(list, 10, "list int");
    text += std::to_string(4 * mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
        text += " " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + " -1";
    }
    return text + "\n";
}

std::string obj(const TriangleMesh& mesh, bool counts_backwards) {
    std::string text = "# made by a test\nmtllib none.mtl\no box\n";
    const auto count = static_cast<std::int64_t>(mesh.points.size());
    for (const Vec3& p : mesh.points) {
        text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
    }
    text += "vt 0 0\nvn 0 0 1\ns off\n";
    for (const Triangle& t : mesh.triangles) {
        text += "f";
        for (const std::uint32_t corner : t) {
            text += counts_backwards ? " " + std::to_string(std::int64_t{corner} - count) + "//-1"
                                     : " " + std::to_string(corner + 1) + "/1/1";
        }
        text += "\n";
    }
    return text;
}

std::string off(const TriangleMesh& mesh, bool has_colours) {
    std::string text = std::string(has_colours ? "COFF" : "OFF") + "\n# made by a test\n" +
                       std::to_string(mesh.points.size()) + " " + std::to_string(mesh.triangles.size()) + " 0\n";
    for (const Vec3& p : mesh.points) {
        text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) +
                (has_colours ? " 255 0 0 255\n" : "\n");
    }
    for (const Triangle& t : mesh.triangles) {
        text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) +
                (has_colours ? " 0.5 0.5 0.5\n" : "\n");
    }
    return text;
}

// A turned component of a mirrored item, and a support.
Bytes components_3mf(const TriangleMesh& mesh) {
    const std::string objects = object_3mf(mesh, 1) + object_3mf(mesh, 4, "type=\"support\"") +
                                "<object id=\"2\"><components><component objectid=\"1\" transform=\"0 1 0 -1 0 0 0 0 1 "
                                "9 9 9\"/></components></object>";
    return package_3mf({{"3D/a.model", model_3mf(objects,
                                                 "<item objectid=\"2\" transform=\"1 0 0 0 1 0 0 0 -1 0 0 0\"/>"
                                                 "<item objectid=\"4\"/>",
                                                 "unit=\"inch\"")}});
}

}  // namespace

std::vector<Encoded> encodings() {
    TriangleMesh mesh = shapes::box({0, 0, 0}, {1, 2, 3});
    std::vector<Encoded> all;
    all.push_back({"ply", "ascii", bytes_of(ascii_ply(mesh)), 1});
    all.push_back({"stl", "ascii", bytes_of(ascii_stl(mesh)), 6});
    all.push_back({"stl", "binary", to_stl(mesh)});
    all.push_back({"ply", "odd", bytes_of(odd_ply(mesh)), 8});
    all.push_back({"ply", "strips", bytes_of(strips_ply(mesh)), 1});
    mesh.cap_of.assign(mesh.triangles.size(), 3);
    all.push_back({"ply", "little-endian", to_ply(mesh)});
    all.push_back({"ply", "big-endian", big_endian_ply(mesh)});
    mesh.cap_of.clear();
    all.push_back({"obj", "plain", bytes_of(obj(mesh, false)), whole_lines});
    all.push_back({"obj", "backwards", bytes_of(obj(mesh, true)), whole_lines});
    all.push_back({"obj", "utf-16", utf16(obj(mesh, false), true), whole_lines});
    all.push_back({"off", "plain", bytes_of(off(mesh, false)), 1});
    all.push_back({"off", "colours", bytes_of(off(mesh, true)), 13});
    all.push_back({"gltf", "json", bytes_of(gltf_of(mesh))});
    all.push_back({"gltf", "turned",
                   bytes_of(gltf_of(mesh, R"("mesh":0,"rotation":[0,0.6,0,0.8],"scale":[1,-2,1],)"
                                          R"("translation":[1,2,3],"name":"box","extras":{"a":[1]})"))});
    GlbScene scene;
    scene.nodes.push_back({"piece/A", &mesh, {1, 2, 3}, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}, {{"step", 1}}});
    all.push_back({"gltf", "binary", to_glb(scene)});
    const Solid3mf solid{"A", &mesh, {}};
    all.push_back({"3mf", "package", to_3mf(std::span(&solid, 1), {{"Title", "box"}})});
    all.push_back({"3mf", "components", components_3mf(mesh)});
    all.push_back({"any", "gzip ply", gzipped(to_ply(mesh))});
    all.push_back({"any", "gzip stl", gzipped(to_stl(mesh))});
    all.push_back({"any", "utf-16 stl", utf16(ascii_stl(mesh), false), 12});
    return all;
}

}  // namespace qchopper
