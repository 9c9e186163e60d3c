// The file is read as a mesh first, which refuses all damage; then the vertices are passed over again for their marks.
// O(bytes).

#include "segment/io/read_painted.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "segment/io/formats/ply_header.h"
#include "segment/io/formats/ply_values.h"
#include "segment/io/formats/read_ply.h"

namespace qchopper {
namespace {

using MarkNames = std::array<std::string_view, 4>;
constexpr MarkNames ignore_names{"ignore", "mask", "scalar_ignore", "scalar_mask"};
constexpr MarkNames no_cut_names{"no_cut", "mask", "scalar_no_cut", "scalar_mask"};
constexpr double min_red = 200;
constexpr double max_other = 60;

// How marks are read: by one property, or by three as a colour. Indices of the vertex's properties.
struct MarkSource {
    std::vector<std::size_t> property;  // one or three
    double to_255 = 1;                  // factor of the colours
    bool is_marked(const std::vector<double>& value) const {
        if (value.size() == 1) return value[0] < 0 || value[0] > 0;  // not a number: not marked
        return to_255 * value[0] >= min_red && to_255 * value[1] <= max_other && to_255 * value[2] <= max_other;
    }
};

std::optional<std::size_t> property_named(const PlyElement& vertex, std::string_view name) {
    const auto found = std::find_if(vertex.properties.begin(), vertex.properties.end(),
                                    [&](const PlyProperty& p) { return !p.is_list && p.name == name; });
    if (found == vertex.properties.end()) return std::nullopt;
    return static_cast<std::size_t>(found - vertex.properties.begin());
}

std::optional<MarkSource> mark_source(const PlyElement& vertex, const MarkNames& names) {
    for (const std::string_view name : names) {
        if (const auto property = property_named(vertex, name)) return MarkSource{{*property}};
    }
    for (const std::string prefix : {"", "diffuse_"}) {
        MarkSource source;
        for (const char* colour : {"red", "green", "blue"}) {
            if (const auto property = property_named(vertex, prefix + colour)) source.property.push_back(*property);
        }
        if (source.property.size() != 3) continue;
        source.to_255 = is_integer(vertex.properties[source.property[0]].type) ? 1 : 255;
        return source;
    }
    return std::nullopt;
}

// Precondition for all below: the file was read as a mesh, so no value is missing.
template <class Values>
double next_value(Values& values, const PlyProperty& property) {
    std::int64_t count = property.is_list ? values.whole(property.count_type).value_or(0) : 1;
    double value = 0;
    for (; count > 0; --count) value = values.real(property.type).value_or(0);
    return value;
}

template <class Values>
std::vector<std::uint8_t> marks(const PlyHeader& header, Values values, const MarkSource& source) {
    for (const PlyElement& element : header.elements) {
        const bool is_vertex = element.name == "vertex";
        std::vector<std::uint8_t> is_marked;
        std::vector<double> value(element.properties.size());
        std::vector<double> wanted(source.property.size());
        for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
            for (std::size_t p = 0; p < value.size(); ++p) value[p] = next_value(values, element.properties[p]);
            values.end_element();
            if (!is_vertex) continue;
            std::transform(source.property.begin(), source.property.end(), wanted.begin(),
                           [&](std::size_t p) { return value[p]; });
            is_marked.push_back(source.is_marked(wanted) ? 1 : 0);
        }
        if (is_vertex) return is_marked;
    }
    return {};
}

MarkedPoints parse_marked(const Bytes& bytes, const std::string& name, const MarkNames& names,
                          const std::string& page) {
    if (!is_ply(bytes)) {
        throw InputError(InputFault::mesh, name + " is not a PLY file", "export the painted scan as PLY");
    }
    MarkedPoints marked{parse_ply(bytes, name).mesh, {}};
    const std::string_view file = as_text(bytes);
    const PlyHeader header = read_ply_header(file, name);
    const auto vertex = std::find_if(header.elements.begin(), header.elements.end(),
                                     [](const PlyElement& e) { return e.name == "vertex"; });
    const auto source = vertex == header.elements.end() ? std::nullopt : mark_source(*vertex, names);
    if (!source) {
        throw InputError(InputFault::mesh,
                         name + " marks nothing: its vertices have neither a property " + std::string(names[0]) +
                             " or mask nor colours",
                         "paint the surface red and export the vertex colours too (" + page + ")");
    }
    marked.is_marked = with_values(header, file, [&](const auto& values) { return marks(header, values, *source); });
    marked.mesh.cap_of.clear();
    return marked;
}

}  // namespace

MarkedPoints parse_no_cut_ply(const Bytes& bytes, const std::string& name) {
    return parse_marked(bytes, name, no_cut_names, "docs/user/candidate-planes.md");
}

TriangleMesh parse_painted_ply(const Bytes& bytes, const std::string& name) {
    auto [mesh, is_marked] = parse_marked(bytes, name, ignore_names, "docs/user/ignored-surface.md");
    mesh.ignored.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
        mesh.ignored.push_back(is_marked[t[0]] + is_marked[t[1]] + is_marked[t[2]] >= 2 ? 1 : 0);
    }
    return mesh;
}

}  // namespace qchopper
