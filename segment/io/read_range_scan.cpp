// One pass over the elements, in the order of the header. O(bytes).

#include "segment/io/read_range_scan.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "base/error.h"
#include "base/text.h"
#include "segment/io/formats/ply_header.h"
#include "segment/io/formats/ply_values.h"
#include "segment/io/formats/raw_mesh.h"
#include "segment/io/formats/read_ply.h"

namespace qchopper {
namespace {

constexpr const char* grid_name = "range_grid";
constexpr std::uint64_t max_places = 1U << 30U;

std::string_view text_of(const Bytes& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
    throw InputError(InputFault::mesh, name + ": " + what, export_again);
}

// The number in the line "obj_info KEY N" of a header; 0 if there is none.
std::size_t number_in(std::string_view header, const std::string& key) {
    const std::string before = "obj_info " + key + " ";
    const std::size_t at = header.find(before);
    std::size_t number = 0;
    if (at != std::string_view::npos) {
        const char* first = header.data() + at + before.size();
        std::from_chars(first, header.data() + header.size(), number);
    }
    return number;
}

const PlyElement* element_named(const PlyHeader& header, std::string_view name) {
    const auto found = std::ranges::find(header.elements, name, &PlyElement::name);
    return found == header.elements.end() ? nullptr : &*found;
}

template <class Values>
class RangeBody {
 public:
    RangeBody(const PlyHeader& header, Values values, const std::string& name, RangeScan& scan)
        : header_(header), values_(values), name_(name), scan_(scan) {}

    void read() {
        for (const PlyElement& element : header_.elements) {
            // Each entry has a byte or a character at the least, so that no count asks for more memory than the file
            // is.
            if (!values_.can_hold(element.count, element.count)) {
                refuse(name_, "line " + std::to_string(element.line) + " announces more entries of \"" + element.name +
                                  "\" than the file has room for");
            }
            for (std::uint64_t i = 0; i < element.count; ++i) {
                if (element.name == "vertex") {
                    read_point(element);
                } else if (element.name == grid_name) {
                    read_place(element);
                } else {
                    for (const PlyProperty& property : element.properties) pass(property);
                }
                values_.end_element();
            }
        }
        const auto is_valid = [&](std::uint32_t i) { return i == RangeScan::no_point || i < scan_.points.size(); };
        if (!std::ranges::all_of(scan_.grid, is_valid)) refuse(name_, "the grid names a point that is not there");
    }

 private:
    [[noreturn]] void refuse_value() { refuse(name_, values_.place() + ": a value is missing or no number"); }

    void read_point(const PlyElement& element) {
        Vec3 point;
        for (const PlyProperty& property : element.properties) {
            if (property.is_list || property.name.size() != 1 || property.name[0] < 'x' || property.name[0] > 'z') {
                pass(property);
                continue;
            }
            const std::optional<double> value = values_.real(property.type);
            if (!value || !std::isfinite(*value)) refuse_value();
            point[property.name[0] - 'x'] = *value;
        }
        scan_.points.push_back(point);
    }

    void read_place(const PlyElement& element) {
        std::uint32_t point = RangeScan::no_point;
        for (const PlyProperty& property : element.properties) {
            if (!property.is_list) {
                pass(property);
                continue;
            }
            const std::int64_t count = whole(property.count_type);
            if (count < 0 || count > 1) refuse(name_, values_.place() + ": a place of the grid lists several points");
            if (count == 0) continue;
            const std::int64_t index = whole(property.type);
            if (index < 0 || index >= RangeScan::no_point) refuse_value();
            point = static_cast<std::uint32_t>(index);
        }
        scan_.grid.push_back(point);
    }

    std::int64_t whole(PlyType type) {
        const std::optional<std::int64_t> value = values_.whole(type);
        if (!value) refuse_value();
        return *value;
    }

    void pass(const PlyProperty& property) {
        std::int64_t count = property.is_list ? whole(property.count_type) : 1;
        for (; count > 0; --count) {
            if (!values_.skip(property.type)) refuse_value();
        }
    }

    const PlyHeader& header_;
    Values values_;
    const std::string& name_;
    RangeScan& scan_;
};

}  // namespace

bool is_range_scan(const Bytes& bytes) {
    constexpr std::size_t longest_header = 100'000;
    if (!is_ply(bytes)) return false;
    const std::string_view text = text_of(bytes).substr(0, longest_header);
    const std::string_view header = text.substr(0, text.find("end_header"));
    return header.find(std::string("element ") + grid_name) != std::string_view::npos;
}

RangeScan parse_range_scan(const Bytes& bytes, const std::string& name) {
    const std::string_view text = text_of(bytes);
    const PlyHeader header = read_ply_header(text, name);
    RangeScan scan;
    scan.columns = number_in(text.substr(0, header.size), "num_cols");
    scan.rows = number_in(text.substr(0, header.size), "num_rows");
    if (scan.columns == 0 || scan.rows == 0) {
        refuse(name, "the header does not say how large the grid is: obj_info num_cols and num_rows");
    }
    const PlyElement* grid = element_named(header, grid_name);
    const PlyElement* points = element_named(header, "vertex");
    if (grid == nullptr || points == nullptr) refuse(name, "the file has no points or no grid");
    if (scan.columns > max_places || scan.rows > max_places || grid->count != scan.columns * scan.rows) {
        refuse(name, "the grid has " + with_commas(grid->count) + " places, not the " + std::to_string(scan.columns) +
                         " x " + std::to_string(scan.rows) + " that the header states");
    }
    with_values(header, text, [&](auto values) { RangeBody(header, values, name, scan).read(); });
    return scan;
}

}  // namespace qchopper
