// Binary files are read at fixed offsets, text word by word. Welding while reading: corners are found in a hash table,
// whose slots are prefetched in batches. O(bytes) expected.

#include "segment/io/formats/read_stl.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <string_view>

#include "base/error.h"
#include "base/huge_pages.h"
#include "segment/io/formats/text.h"
#include "segment/mesh/point_table.h"

namespace qchopper {
namespace {

constexpr std::size_t header_size = 80;
constexpr std::size_t start_of_triangles = header_size + 4;
constexpr std::size_t triangle_size = 50;

std::uint32_t u32_at(const Bytes& bytes, std::size_t at) {
    return std::uint32_t{bytes[at]} | std::uint32_t{bytes[at + 1]} << 8 | std::uint32_t{bytes[at + 2]} << 16 |
           std::uint32_t{bytes[at + 3]} << 24;
}

double float_at(const Bytes& bytes, std::size_t at) {
    return std::bit_cast<float>(u32_at(bytes, at));
}

bool is_finite(Vec3 p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

// Reads the text of one file; every fault is refused with its line.
class AsciiStl {
 public:
    AsciiStl(std::string_view text, const std::string& name) : text_(text), name_(name) {}

    RawMesh read() {
        RawMesh scan;
        scan.format = MeshFormat::stl_ascii;
        for (std::string_view word = text_.word(); !word.empty(); word = text_.word()) {
            if (!equals_ignoring_case(word, "solid")) refuse("solid", word);
            text_.rest_of_line();  // the name of the solid
            read_solid(scan.mesh);
        }
        scan.faces_in_file = scan.mesh.triangles.size();
        return scan;
    }

 private:
    void read_solid(TriangleMesh& mesh) {
        while (true) {
            const std::string_view word = text_.word();
            if (equals_ignoring_case(word, "endsolid")) break;
            if (!equals_ignoring_case(word, "facet")) refuse("facet or endsolid", word);
            read_facet(mesh);
        }
        text_.rest_of_line();
    }

    void read_facet(TriangleMesh& mesh) {
        expect("normal");
        // the normal follows from the points, and some writers put "nan" here
        for (int i = 0; i < 3; ++i) {
            if (text_.word().empty()) refuse("a normal", {});
        }
        expect("outer");
        expect("loop");
        const auto first = static_cast<std::uint32_t>(mesh.points.size());
        for (int corner = 0; corner < 3; ++corner) mesh.points.push_back(read_vertex(first + corner));
        expect("endloop");
        expect("endfacet");
        mesh.triangles.push_back({first, first + 1, first + 2});
    }

    Vec3 read_vertex(std::size_t index) {
        expect("vertex");
        Vec3 point;
        for (int axis = 0; axis < 3; ++axis) {
            const std::string_view word = text_.word();
            const std::optional<double> value = number(word);
            if (!value) refuse("a coordinate", word);
            if (!std::isfinite(*value)) {
                throw InputError(InputFault::mesh,
                                 name_ + ": vertex " + std::to_string(index) + " in line " +
                                     std::to_string(text_.line()) + " has a coordinate that is not a finite number",
                                 "export the scan again");
            }
            point[axis] = *value;
        }
        return point;
    }

    void expect(std::string_view wanted) {
        const std::string_view word = text_.word();
        if (!equals_ignoring_case(word, wanted)) refuse(wanted, word);
    }

    [[noreturn]] void refuse(std::string_view wanted, std::string_view got) const {
        const std::string found = got.empty() ? "the file ends" : "it has \"" + std::string(got.substr(0, 40)) + "\"";
        throw InputError(InputFault::mesh,
                         name_ + ": line " + std::to_string(text_.line()) + " of the ASCII STL should continue with " +
                             std::string(wanted) + ", but " + found,
                         export_again);
    }

    Text text_;
    const std::string& name_;
};

class BinaryStl {
 public:
    BinaryStl(const Bytes& bytes, const std::string& name, std::uint32_t count)
        : bytes_(bytes), name_(name), count_(count) {}

    void read(TriangleMesh& mesh) const {
        reserve_huge(mesh.points, 3 * std::size_t{count_});
        for (std::uint32_t t = 0; t < count_; ++t) {
            for (std::uint32_t corner = 0; corner < 3; ++corner) mesh.points.push_back(point(t, corner));
            mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
        }
    }

    void read_welded(RawMesh& scan) const {
        std::vector<Vec3>& points = scan.mesh.points;
        const std::size_t usual = count_ / 2 + 2;  // of a closed surface
        reserve_huge(points, usual + usual / 16);
        PointTable table(usual);
        constexpr std::uint32_t batch = 16;  // triangles whose slots are prefetched together
        std::array<Vec3, 3 * batch> corners;
        std::array<std::uint64_t, 3 * batch> hash{};
        for (std::uint32_t begin = 0; begin < count_; begin += batch) {
            const std::uint32_t size = std::min(batch, count_ - begin);
            for (std::uint32_t i = 0; i < 3 * size; ++i) {
                corners[i] = positive_zeros(point(begin + i / 3, i % 3));
                hash[i] = PointTable::hash_of(corners[i]);
                table.prefetch(hash[i]);
            }
            const auto number = [&](std::uint32_t i) {
                const auto next = static_cast<std::uint32_t>(points.size());
                const std::uint32_t found = table.find_or_note(points, corners[i], hash[i], next);
                if (found == next) points.push_back(corners[i]);
                return found;
            };
            for (std::uint32_t i = 0; i < 3 * size; i += 3) {
                const std::uint32_t a = number(i);
                const std::uint32_t b = number(i + 1);
                scan.mesh.triangles.push_back({a, b, number(i + 2)});
            }
        }
        scan.welded = 3 * std::size_t{count_} - points.size();
    }

 private:
    Vec3 point(std::uint32_t triangle, std::uint32_t corner) const {
        const std::size_t at = start_of_triangles + triangle_size * triangle + 12 + 12 * corner;
        const Vec3 p{float_at(bytes_, at), float_at(bytes_, at + 4), float_at(bytes_, at + 8)};
        if (!is_finite(p)) {
            throw InputError(InputFault::mesh,
                             name_ + ": vertex " + std::to_string(corner) + " of triangle " + std::to_string(triangle) +
                                 " (byte " + std::to_string(at) + ") has a coordinate that is not a finite number",
                             "export the scan again");
        }
        return p;
    }

    const Bytes& bytes_;
    const std::string& name_;
    std::uint32_t count_;
};

}  // namespace

bool is_binary_stl(const Bytes& bytes) {
    if (bytes.size() < start_of_triangles) return false;
    return bytes.size() == start_of_triangles + triangle_size * std::size_t{u32_at(bytes, header_size)};
}

bool is_ascii_stl(const Bytes& bytes) {
    Text text(as_text(bytes));
    if (!equals_ignoring_case(text.word(), "solid")) return false;
    // a binary file has a zero byte within its first triangles, a text has none
    const std::string_view start = as_text(bytes).substr(0, 1024);
    return std::find(start.begin(), start.end(), '\0') == start.end();
}

std::string why_no_binary_stl(const Bytes& bytes) {
    if (bytes.size() < start_of_triangles) return "a binary STL has 84 bytes or more";
    const std::size_t count = u32_at(bytes, header_size);
    return "a binary STL of " + std::to_string(count) + " triangles has " +
           std::to_string(start_of_triangles + triangle_size * count) + " bytes, but the file has " +
           std::to_string(bytes.size());
}

RawMesh parse_binary_stl(const Bytes& bytes, const std::string& name, bool weld) {
    assert(is_binary_stl(bytes));
    const std::uint32_t count = u32_at(bytes, header_size);
    constexpr std::uint32_t too_many = 0x55555555;  // half-edges are numbered in 32 bits
    if (count >= too_many) throw InputError(InputFault::mesh, name + ": more than 1.4 billion triangles");
    RawMesh scan;
    scan.format = MeshFormat::stl_binary;
    scan.faces_in_file = count;
    reserve_huge(scan.mesh.triangles, count);
    const BinaryStl file(bytes, name, count);
    if (weld) {
        file.read_welded(scan);
    } else {
        file.read(scan.mesh);
    }
    return scan;
}

RawMesh parse_ascii_stl(const Bytes& bytes, const std::string& name) {
    return AsciiStl(as_text(bytes), name).read();
}

}  // namespace qchopper
