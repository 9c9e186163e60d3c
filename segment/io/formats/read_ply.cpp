// One pass over the elements, in the order of the header, after G. Turk, "The PLY Polygon File Format", 1994. O(bytes);
// add_face.cpp states the cost of polygons.

#include "segment/io/formats/read_ply.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "base/error.h"
#include "segment/io/formats/add_face.h"
#include "segment/io/formats/ply_header.h"
#include "segment/io/formats/ply_values.h"
#include "segment/io/formats/read_plain_ply.h"

namespace qchopper {
namespace {

template <class Values>
class PlyBody {
 public:
    PlyBody(const PlyHeader& header, Values values, const std::string& name)
        : header_(header), values_(values), name_(name) {}

    RawMesh read() {
        scan_.format = header_.format;
        check_elements();
        for (const PlyElement& element : header_.elements) {
            if (element.properties.empty() && element.name != "vertex") continue;  // it has no data
            check_count(element);
            if (element.name == "vertex") {
                read_vertices(element, scan_.mesh.points);
            } else if (element.name == "face") {
                read_faces(element);
            } else if (element.name == "tristrips") {
                read_strips(element);
            } else {
                skip_element(element);
            }
        }
        if (!values_.is_at_end()) {
            refuse(values_.place() + ": more data follow than the header announces");
        }
        add_early_faces();
        if (scan_.mesh.triangles.size() > max_triangles) refuse("more than 1.4 billion triangles");
        return std::move(scan_);
    }

 private:
    void check_elements() {
        bool has_faces = false;
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex") point_count_ = element.count;
            const bool is_surface = element.name == "face" || element.name == "tristrips";
            if (is_surface && element.count > 0) has_faces = true;
        }
        if (point_count_ > max_points) refuse("more than 4 billion points");
        if (!has_faces) {
            throw InputError(InputFault::mesh, name_ + " holds no faces",
                             "export the scan as a surface, not as points");
        }
    }

    // Before memory is reserved: refuses a count that needs more bytes than the file has.
    void check_count(const PlyElement& element) const {
        if (element.properties.empty()) return;
        std::uint64_t bytes = 0;
        for (const PlyProperty& property : element.properties) {
            bytes += size_of(property.is_list ? property.count_type : property.type);
        }
        const std::uint64_t values = element.properties.size();
        const bool fits_64_bits = element.count <= std::numeric_limits<std::uint64_t>::max() / bytes;
        if (fits_64_bits && values_.can_hold(element.count * values, element.count * bytes)) return;
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
                    skip_property(element.properties[i], "vertex", v);
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
        check_corner_list(element, "face");
        has_cap_ = std::any_of(element.properties.begin(), element.properties.end(), is_cap);
        scan_.mesh.triangles.reserve(element.count);
        std::int32_t cap = no_cap;
        for (std::uint64_t f = 0; f < element.count; ++f) {
            for (const PlyProperty& property : element.properties) {
                if (is_corner_list(property)) {
                    read_corners(property, f);
                } else if (is_cap(property)) {
                    const std::optional<std::int64_t> value = values_.whole(property.type);
                    if (!value || *value < no_cap || *value > std::numeric_limits<std::int32_t>::max()) {
                        refuse_value("face", f, property.name);
                    }
                    cap = static_cast<std::int32_t>(*value);
                } else {
                    skip_property(property, "face", f);
                }
            }
            values_.end_element();
            add_or_keep_face(cap);
        }
    }

    void check_corner_list(const PlyElement& element, const std::string& what) const {
        const auto lists = std::count_if(element.properties.begin(), element.properties.end(), is_corner_list);
        if (lists != 1) refuse("a " + what + " needs one list of integers named vertex_indices or vertex_index");
    }

    static bool is_corner_list(const PlyProperty& property) {
        return property.is_list && is_integer(property.type) &&
               (property.name == "vertex_indices" || property.name == "vertex_index");
    }
    static bool is_cap(const PlyProperty& property) {
        return !property.is_list && is_integer(property.type) && property.name == "cap";
    }

    // Fills corners_.
    void read_corners(const PlyProperty& property, std::uint64_t face) {
        const std::optional<std::int64_t> count = values_.whole(property.count_type);
        if (!count || *count < 0) refuse_value("face", face, "number of corners");
        if (*count > max_corners) {
            refuse("face " + std::to_string(face) + " (" + values_.place() + ") has " + std::to_string(*count) +
                   " corners; " + std::to_string(max_corners) + " is the most that is read");
        }
        corners_.clear();
        for (std::int64_t i = 0; i < *count; ++i)
            corners_.push_back(checked(read_corner(property, "face", face), face));
    }

    std::int64_t read_corner(const PlyProperty& property, const std::string& what, std::uint64_t index) {
        const std::optional<std::int64_t> corner = values_.whole(property.type);
        if (!corner) refuse_value(what, index, property.name);
        return *corner;
    }

    std::uint32_t checked(std::int64_t corner, std::uint64_t face, const std::string& what = "face") const {
        if (corner < 0 || static_cast<std::uint64_t>(corner) >= point_count_) {
            refuse(what + " " + std::to_string(face) + " (" + values_.place() + ") names vertex " +
                   std::to_string(corner) + ", but there are " + std::to_string(point_count_));
        }
        return static_cast<std::uint32_t>(corner);
    }

    // The face in corners_: now, or when its points are read.
    void add_or_keep_face(std::int32_t cap) {
        if (scan_.mesh.points.size() != point_count_) return early_.keep(corners_, cap);
        add_face(scan_, corners_);
        if (has_cap_) scan_.mesh.cap_of.resize(scan_.mesh.triangles.size(), cap);
    }

    void add_early_faces() {
        for (std::size_t f = 0; f < early_.end.size(); ++f) {
            add_face(scan_, early_.corners_of(f));
            if (!has_cap_) continue;
            scan_.mesh.cap_of.resize(scan_.mesh.triangles.size(), static_cast<std::int32_t>(early_.note[f]));
        }
        // strips have no caps
        if (has_cap_) scan_.mesh.cap_of.resize(scan_.mesh.triangles.size(), no_cap);
    }

    // Each corner makes a triangle with the two before it; -1 begins a new strip. Triangles with a repeated corner
    // only connect two strips and are left out.
    void read_strips(const PlyElement& element) {
        check_corner_list(element, "strip");
        for (std::uint64_t s = 0; s < element.count; ++s) {
            for (const PlyProperty& property : element.properties) {
                if (is_corner_list(property)) {
                    read_strip(property, s);
                } else {
                    skip_property(property, "strip", s);
                }
            }
            values_.end_element();
        }
    }

    void read_strip(const PlyProperty& property, std::uint64_t strip) {
        const std::optional<std::int64_t> count = values_.whole(property.count_type);
        if (!count || *count < 0) refuse_value("strip", strip, "number of corners");
        Triangle t{};
        std::size_t length = 0;
        for (std::int64_t i = 0; i < *count; ++i) {
            const std::int64_t corner = read_corner(property, "strip", strip);
            if (corner == -1) {
                length = 0;
                continue;
            }
            t = {t[1], t[2], checked(corner, strip, "strip")};
            if (++length < 3 || t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
            const bool is_reversed = length % 2 == 0;
            scan_.mesh.triangles.push_back(is_reversed ? Triangle{t[1], t[0], t[2]} : t);
            ++scan_.faces_in_file;
        }
    }

    void skip_element(const PlyElement& element) {
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const PlyProperty& property : element.properties) skip_property(property, element.name, i);
            values_.end_element();
        }
    }

    void skip_property(const PlyProperty& property, const std::string& element, std::uint64_t index) {
        std::int64_t count = 1;
        if (property.is_list) {
            const std::optional<std::int64_t> listed = values_.whole(property.count_type);
            if (!listed || *listed < 0) refuse_value(element, index, property.name);
            count = *listed;
        }
        for (std::int64_t i = 0; i < count; ++i) {
            if (!values_.skip(property.type)) refuse_value(element, index, property.name);
        }
    }

    [[noreturn]] void refuse_value(const std::string& element, std::uint64_t index, const std::string& what) const {
        refuse("the file ends or is damaged at " + values_.place() + ", in " + element + " " + std::to_string(index) +
               " (" + what + ")");
    }

    [[noreturn]] void refuse(const std::string& why) const {
        throw InputError(InputFault::mesh, name_ + ": " + why, export_again);
    }

    const PlyHeader& header_;
    Values values_;
    const std::string& name_;
    RawMesh scan_;
    std::uint64_t point_count_ = 0;
    bool has_cap_ = false;
    std::vector<std::uint32_t> corners_;  // of the face that is being read
    EarlyFaces early_;                    // the note is the cap
};

}  // namespace

bool is_ply(const Bytes& bytes) {
    return bytes.size() >= 4 && bytes[0] == 'p' && bytes[1] == 'l' && bytes[2] == 'y' &&
           (bytes[3] == '\n' || bytes[3] == '\r' || bytes[3] == ' ');
}

RawMesh parse_ply(const Bytes& bytes, const std::string& name) {
    const std::string_view file = as_text(bytes);
    const PlyHeader header = read_ply_header(file, name);
    if (std::optional<RawMesh> scan = read_plain_ply(header, file)) return std::move(*scan);
    return with_values(header, file, [&](const auto& values) { return PlyBody(header, values, name).read(); });
}

}  // namespace qchopper
