#include "tests/segment/io/wrappings.h"

#include <zlib.h>

#include <bit>
#include <cstdint>
#include <stdexcept>

#include "base/files/zip.h"

namespace qchopper {
namespace {

void put_u32(Bytes& bytes, std::size_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

std::string base64(const Bytes& bytes) {
    constexpr const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < n ? bytes[i + k] : 0U);
        for (std::size_t k = 0; k < 4; ++k) text += k <= n ? letters[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string digits(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

}  // namespace

Bytes gzipped(const Bytes& bytes) {
    z_stream stream{};
    if (deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) != Z_OK) throw std::runtime_error("zlib");
    Bytes packed(deflateBound(&stream, bytes.size()));
    stream.next_in = const_cast<Bytef*>(bytes.data());
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = packed.data();
    stream.avail_out = static_cast<uInt>(packed.size());
    const int state = deflate(&stream, Z_FINISH);
    packed.erase(packed.begin() + static_cast<std::ptrdiff_t>(stream.total_out), packed.end());
    deflateEnd(&stream);
    if (state != Z_STREAM_END) throw std::runtime_error("zlib");
    return packed;
}

Bytes utf16(const std::string& text, bool is_big_endian) {
    Bytes bytes;
    const auto put = [&](unsigned unit) {
        const std::uint8_t high = static_cast<std::uint8_t>(unit >> 8);
        const std::uint8_t low = static_cast<std::uint8_t>(unit);
        bytes.push_back(is_big_endian ? high : low);
        bytes.push_back(is_big_endian ? low : high);
    };
    put(0xfeff);
    for (const char c : text) put(static_cast<std::uint8_t>(c));
    return bytes;
}

std::string gltf_text(const Bytes& numbers, const std::string& rest) {
    return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":)" + std::to_string(numbers.size()) +
           R"(,"uri":"data:application/octet-stream;base64,)" + base64(numbers) + "\"}]," + rest + "}";
}

Bytes float_points(const std::vector<Vec3>& points) {
    Bytes bytes;
    for (const Vec3& p : points) {
        for (int axis = 0; axis < 3; ++axis) put_u32(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(p[axis])));
    }
    return bytes;
}

std::string gltf_of(const TriangleMesh& mesh, const std::string& node) {
    Bytes numbers = float_points(mesh.points);
    const std::string split = std::to_string(numbers.size());
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t corner : t) put_u32(numbers, corner);
    }
    return gltf_text(numbers, R"("bufferViews":[{"buffer":0,"byteLength":)" + split + R"(},{"buffer":0,"byteOffset":)" +
                                  split + R"(,"byteLength":)" + std::to_string(12 * mesh.triangles.size()) +
                                  R"(}],"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" +
                                  std::to_string(mesh.points.size()) +
                                  R"(},{"bufferView":1,"componentType":5125,"type":"SCALAR","count":)" +
                                  std::to_string(3 * mesh.triangles.size()) +
                                  R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)" +
                                  R"("nodes":[{)" + node + R"(}],"scenes":[{"nodes":[0]}],"scene":0)");
}

Bytes glb_of(const std::string& json, const Bytes& numbers) {
    std::string padded = json;
    while (padded.size() % 4 != 0) padded += ' ';
    Bytes bytes{'g', 'l', 'T', 'F'};
    put_u32(bytes, 2);
    put_u32(bytes, 28 + padded.size() + numbers.size());
    put_u32(bytes, padded.size());
    put_u32(bytes, 0x4e4f534a);
    bytes.insert(bytes.end(), padded.begin(), padded.end());
    put_u32(bytes, numbers.size());
    put_u32(bytes, 0x004e4942);
    bytes.insert(bytes.end(), numbers.begin(), numbers.end());
    return bytes;
}

Bytes package_3mf(const std::vector<std::pair<std::string, std::string>>& parts) {
    const std::string relations =
        R"(<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">)"
        R"(<Relationship Target="/)" +
        parts.front().first +
        R"(" Id="a" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>)";
    std::vector<Bytes> kept{{relations.begin(), relations.end()}};
    kept.reserve(parts.size() + 1);
    std::vector<ZipEntry> entries{zip_entry("_rels/.rels", kept[0])};
    for (const auto& [name, text] : parts) {
        kept.emplace_back(text.begin(), text.end());
        entries.push_back(zip_entry(name, kept.back()));
        entries.back().is_packed = true;
    }
    return zip(entries);
}

std::string object_3mf(const TriangleMesh& mesh, int id, const std::string& attributes) {
    std::string text = "<object id=\"" + std::to_string(id) + "\" " + attributes + "><mesh><vertices>";
    for (const Vec3& p : mesh.points) {
        text += "<vertex x=\"" + digits(p.x) + "\" y=\"" + digits(p.y) + "\" z=\"" + digits(p.z) + "\"/>";
    }
    text += "</vertices><triangles>";
    for (const Triangle& t : mesh.triangles) {
        text += "<triangle v1=\"" + std::to_string(t[0]) + "\" v2=\"" + std::to_string(t[1]) + "\" v3=\"" +
                std::to_string(t[2]) + "\"/>\n";
    }
    return text + "</triangles></mesh></object>\n";
}

std::string model_3mf(const std::string& resources, const std::string& build, const std::string& attributes) {
    return R"(<?xml version="1.0" encoding="UTF-8"?><model xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" )" +
           attributes + ">\n<resources>" + resources + "</resources>\n<build>" + build + "</build></model>\n";
}

}  // namespace qchopper
