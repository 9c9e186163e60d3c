#include "segment/intake/read_ply.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "segment/error.h"
#include "segment/intake/ply_header.h"
#include "segment/intake/polygon.h"
#include "segment/intake/text.h"

namespace qchopper {
namespace {

constexpr std::uint64_t most_points = std::numeric_limits<std::uint32_t>::max() - 1;
constexpr std::size_t most_triangles = 0x55555554;  // half-edges are numbered in 32 bits
constexpr std::int64_t most_corners = 255;
constexpr const char* copy_again = "export or copy the file again";

// Values of an ASCII body, word by word. Where a value is missing or wrong the answer is nothing.
class AsciiValues {
 public:
    AsciiValues(std::string_view body, std::size_t lines) : text_(body), lines_before_(lines) {}

    std::optional<double> real(PlyType) { return number(text_.word()); }
    std::optional<std::int64_t> whole(PlyType) { return integer(text_.word()); }
    bool pass(PlyType) { return !text_.word().empty(); }
    std::string place() const { return "line " + std::to_string(lines_before_ + text_.line()); }
    // How many values of these sizes may still come: a character and a space each.
    bool has_room(std::uint64_t values, std::uint64_t /*bytes*/) const { return values <= (text_.left() + 1) / 2; }
    bool is_used_up() { return text_.word().empty(); }
    // The next element begins in a line of its own; some writers leave more values in a line than they announce.
    void end_element() { text_.rest_of_line(); }

 private:
    Text text_;
    std::size_t lines_before_;
};

// Values of a binary body.
template <std::endian order>
class BinaryValues {
 public:
    BinaryValues(std::string_view file, std::size_t start) : file_(file), at_(start) {}

    std::optional<double> real(PlyType type) {
        if (type == PlyType::f32 && left() >= 4) return std::bit_cast<float>(take<std::uint32_t>());
        if (type == PlyType::f64 && left() >= 8) return std::bit_cast<double>(take<std::uint64_t>());
        if (!is_integer(type)) return {};
        const std::optional<std::int64_t> value = whole(type);
        if (!value) return {};
        return static_cast<double>(*value);
    }

    std::optional<std::int64_t> whole(PlyType type) {
        if (left() < size_of(type)) return {};
        switch (type) {
            case PlyType::i8:
                return static_cast<std::int8_t>(take<std::uint8_t>());
            case PlyType::u8:
                return take<std::uint8_t>();
            case PlyType::i16:
                return static_cast<std::int16_t>(take<std::uint16_t>());
            case PlyType::u16:
                return take<std::uint16_t>();
            case PlyType::i32:
                return static_cast<std::int32_t>(take<std::uint32_t>());
            case PlyType::u32:
                return take<std::uint32_t>();
            default:
                return {};
        }
    }

    bool pass(PlyType type) {
        if (left() < size_of(type)) return false;
        at_ += size_of(type);
        return true;
    }

    std::string place() const { return "byte " + std::to_string(at_); }
    bool has_room(std::uint64_t /*values*/, std::uint64_t bytes) const { return bytes <= left(); }

    void end_element() {}

    // Some writers end a binary file with a line end or fill it up with zeros.
    bool is_used_up() const {
        return std::all_of(file_.begin() + static_cast<std::ptrdiff_t>(at_), file_.end(),
                           [](char c) { return c == '\0' || c == ' ' || (c >= '\t' && c <= '\r'); });
    }

 private:
    std::size_t left() const { return file_.size() - at_; }

    template <class Unsigned>
    Unsigned take() {
        Unsigned value = 0;
        for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
            const std::size_t shift = 8 * (order == std::endian::little ? i : sizeof(Unsigned) - 1 - i);
            value = static_cast<Unsigned>(value | static_cast<Unsigned>(static_cast<std::uint8_t>(file_[at_ + i]))
                                                      << shift);
        }
        at_ += sizeof(Unsigned);
        return value;
    }

    std::string_view file_;
    std::size_t at_;
};

// Polygons as the file lists them.
struct Polygons {
    std::vector<std::uint32_t> corners;
    std::vector<std::size_t> end;   // per polygon, where its corners end
    std::vector<std::int32_t> cap;  // per polygon, or empty
};

template <class Values>
class PlyBody {
 public:
    PlyBody(const PlyHeader& header, Values values, const std::string& name)
        : header_(header), values_(values), name_(name) {}

    RawMesh read() {
        RawMesh scan;
        scan.format = header_.format;
        check_elements();
        for (const PlyElement& element : header_.elements) {
            if (element.properties.empty()) continue;
            check_room(element);
            if (element.name == "vertex") {
                read_vertices(element, scan.mesh.points);
            } else if (element.name == "face") {
                read_faces(element);
            } else {
                pass_element(element);
            }
        }
        if (!values_.is_used_up()) {
            refuse(values_.place() + ": more data follow than the header announces");
        }
        split(scan);
        return scan;
    }

 private:
    void check_elements() {
        bool has_faces = false;
        bool has_strips = false;
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex") point_count_ = element.count;
            if (element.name == "face" && element.count > 0) has_faces = true;
            if (element.name == "tristrips" && element.count > 0) has_strips = true;
        }
        if (point_count_ > most_points) refuse("more than 4 billion points");
        if (has_strips && !has_faces) {
            throw InputError(InputFault::mesh, name_ + " holds triangle strips, which are not read",
                             "export the scan as plain triangles");
        }
        if (!has_faces) {
            throw InputError(InputFault::mesh, name_ + " holds no faces",
                             "export the scan as a surface, not as points");
        }
    }

    // Before anything is reserved: does the file have as many bytes as the count asks for, at the very least?
    void check_room(const PlyElement& element) const {
        std::uint64_t bytes = 0;
        for (const PlyProperty& property : element.properties) {
            bytes += size_of(property.is_list ? property.count_type : property.type);
        }
        const std::uint64_t values = element.properties.size();
        const bool fits_64_bits = element.count <= std::numeric_limits<std::uint64_t>::max() / bytes;
        if (fits_64_bits && values_.has_room(element.count * values, element.count * bytes)) return;
        refuse("line " + std::to_string(element.line) + " announces " + std::to_string(element.count) + " of \"" +
               element.name + "\", more than the file has room for");
    }

    void read_vertices(const PlyElement& element, std::vector<Vec3>& points) {
        std::vector<int> axis_of;  // per property; -1: none
        std::array<int, 3> times{};
        for (const PlyProperty& property : element.properties) {
            const bool is_axis = property.name.size() == 1 && property.name >= "x" && property.name <= "z";
            const int axis = is_axis ? property.name[0] - 'x' : -1;
            if (axis >= 0) times[static_cast<std::size_t>(axis)] += property.is_list ? 2 : 1;
            axis_of.push_back(axis);
        }
        if (times != std::array<int, 3>{1, 1, 1}) refuse("a vertex needs the properties x, y and z, once each");
        points.resize(element.count);
        for (std::uint64_t v = 0; v < element.count; ++v) {
            for (std::size_t i = 0; i < axis_of.size(); ++i) {
                if (axis_of[i] < 0) {
                    pass_property(element.properties[i], "vertex", v);
                    continue;
                }
                const std::optional<double> value = values_.real(element.properties[i].type);
                if (!value) refuse_value("vertex", v, element.properties[i].name);
                if (!std::isfinite(*value)) {
                    refuse("vertex " + std::to_string(v) + " (" + values_.place() +
                           ") has a coordinate that is not a finite number");
                }
                points[v][axis_of[i]] = *value;
            }
            values_.end_element();
        }
    }

    void read_faces(const PlyElement& element) {
        std::size_t lists = 0;
        bool has_cap = false;
        for (const PlyProperty& property : element.properties) {
            if (is_corner_list(property)) ++lists;
            if (is_cap(property)) has_cap = true;
        }
        if (lists != 1) refuse("a face needs one list of integers named vertex_indices or vertex_index");
        polygons_.end.reserve(element.count);
        if (has_cap) polygons_.cap.reserve(element.count);
        for (std::uint64_t f = 0; f < element.count; ++f) {
            for (const PlyProperty& property : element.properties) {
                if (is_corner_list(property)) {
                    read_corners(property, f);
                } else if (is_cap(property)) {
                    const std::optional<std::int64_t> cap = values_.whole(property.type);
                    if (!cap || *cap < no_cap || *cap > std::numeric_limits<std::int32_t>::max()) {
                        refuse_value("face", f, property.name);
                    }
                    polygons_.cap.push_back(static_cast<std::int32_t>(*cap));
                } else {
                    pass_property(property, "face", f);
                }
            }
            values_.end_element();
        }
    }

    static bool is_corner_list(const PlyProperty& property) {
        return property.is_list && is_integer(property.type) &&
               (property.name == "vertex_indices" || property.name == "vertex_index");
    }
    static bool is_cap(const PlyProperty& property) {
        return !property.is_list && is_integer(property.type) && property.name == "cap";
    }

    void read_corners(const PlyProperty& property, std::uint64_t face) {
        const std::optional<std::int64_t> count = values_.whole(property.count_type);
        if (!count || *count < 0) refuse_value("face", face, "number of corners");
        if (*count > most_corners) {
            refuse("face " + std::to_string(face) + " (" + values_.place() + ") has " + std::to_string(*count) +
                   " corners; 255 is the most that is read");
        }
        for (std::int64_t i = 0; i < *count; ++i) {
            const std::optional<std::int64_t> corner = values_.whole(property.type);
            if (!corner) refuse_value("face", face, property.name);
            if (*corner < 0 || static_cast<std::uint64_t>(*corner) >= point_count_) {
                refuse("face " + std::to_string(face) + " (" + values_.place() + ") names vertex " +
                       std::to_string(*corner) + ", but there are " + std::to_string(point_count_));
            }
            polygons_.corners.push_back(static_cast<std::uint32_t>(*corner));
        }
        polygons_.end.push_back(polygons_.corners.size());
    }

    void pass_element(const PlyElement& element) {
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const PlyProperty& property : element.properties) pass_property(property, element.name, i);
            values_.end_element();
        }
    }

    void pass_property(const PlyProperty& property, const std::string& element, std::uint64_t index) {
        std::int64_t count = 1;
        if (property.is_list) {
            const std::optional<std::int64_t> listed = values_.whole(property.count_type);
            if (!listed || *listed < 0) refuse_value(element, index, property.name);
            count = *listed;
        }
        for (std::int64_t i = 0; i < count; ++i) {
            if (!values_.pass(property.type)) refuse_value(element, index, property.name);
        }
    }

    void split(RawMesh& scan) const {
        scan.faces_in_file = polygons_.end.size();
        scan.mesh.triangles.reserve(polygons_.end.size());
        std::size_t begin = 0;
        for (std::size_t f = 0; f < polygons_.end.size(); ++f) {
            const std::span<const std::uint32_t> corners(&polygons_.corners[begin], polygons_.end[f] - begin);
            begin = polygons_.end[f];
            if (corners.size() < 3) {
                ++scan.faces_without_area;
                continue;
            }
            if (corners.size() == 3) {
                scan.mesh.triangles.push_back({corners[0], corners[1], corners[2]});
            } else {
                split_polygon(scan.mesh.points, corners, scan.mesh.triangles);
            }
            if (!polygons_.cap.empty()) scan.mesh.cap_of.resize(scan.mesh.triangles.size(), polygons_.cap[f]);
        }
        if (scan.mesh.triangles.size() > most_triangles) refuse("more than 1.4 billion triangles");
    }

    [[noreturn]] void refuse_value(const std::string& element, std::uint64_t index, const std::string& what) const {
        refuse("the file ends or is damaged at " + values_.place() + ", in " + element + " " + std::to_string(index) +
               " (" + what + ")");
    }

    [[noreturn]] void refuse(const std::string& why) const {
        throw InputError(InputFault::mesh, name_ + ": " + why, copy_again);
    }

    const PlyHeader& header_;
    Values values_;
    const std::string& name_;
    std::uint64_t point_count_ = 0;
    Polygons polygons_;
};

}  // namespace

bool is_ply(const Bytes& bytes) {
    return bytes.size() >= 4 && bytes[0] == 'p' && bytes[1] == 'l' && bytes[2] == 'y' &&
           (bytes[3] == '\n' || bytes[3] == '\r' || bytes[3] == ' ');
}

RawMesh parse_ply(const Bytes& bytes, const std::string& name) {
    const std::string_view file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const PlyHeader header = read_ply_header(file, name);
    switch (header.format) {
        case MeshFormat::ply_little_endian:
            return PlyBody(header, BinaryValues<std::endian::little>(file, header.size), name).read();
        case MeshFormat::ply_big_endian:
            return PlyBody(header, BinaryValues<std::endian::big>(file, header.size), name).read();
        default:
            return PlyBody(header, AsciiValues(file.substr(header.size), header.lines - 1), name).read();
    }
}

}  // namespace qchopper
