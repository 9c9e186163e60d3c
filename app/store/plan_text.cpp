// Writes and reads the text of a plan, key by key in the order of docs/user/plan-file.md. O(cuts).

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <sstream>

#include "app/store/plan.h"
#include "base/files/file.h"
#include "base/toml_reader.h"

namespace qchopper {
namespace {

constexpr const char* first_line = "# QChopper plan";
constexpr std::uint32_t schema = 1;
constexpr double most = 1e15;  // of any number but a count
constexpr std::uint32_t max_count = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t longest_text = 1000;  // bytes; the name of a file has at most 255

constexpr std::array<std::string_view, 5> plan_keys{"schema", "scan", "weights", "cut", "discard"};
constexpr std::array<std::string_view, 9> scan_keys{"name",  "sha256",     "units",      "scale",     "centre_mm",
                                                    "faces", "volume_mm3", "box_min_mm", "box_max_mm"};
constexpr auto weight_keys = [] {
    std::array<std::string_view, all_objectives.size()> keys;
    for (std::size_t i = 0; i < keys.size(); ++i) keys[i] = all_objectives[i].key;
    return keys;
}();
constexpr std::array<std::string_view, 9> cut_keys{
    "number", "piece", "path", "normal", "offset_mm", "offset_from_centre_mm", "inside_mm", "volume_mm3", "makes_mm3"};
constexpr std::array<std::string_view, 5> discard_keys{"after", "piece", "path", "inside_mm", "volume_mm3"};

// As many digits as give the same bits again; always with a point or an exponent, so that it stays a float.
std::string in_digits(double value) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.17g", value);
    std::string digits = text.data();
    if (digits.find_first_of(".e") == std::string::npos) digits += ".0";
    return digits;
}

std::string in_digits(Vec3 v) {
    return "[" + in_digits(v.x) + ", " + in_digits(v.y) + ", " + in_digits(v.z) + "]";
}

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
    }
    return out + "\"";
}

std::string describe(const PathSide& side) {
    return std::to_string(side.cut) + (side.above ? " above" : " below");
}

std::string describe(const std::vector<PathSide>& path) {
    std::string text;
    for (const PathSide& side : path) text += (text.empty() ? "" : ", ") + quoted(describe(side));
    return "[" + text + "]";
}

double positive(const TomlReader& t, std::string_view key) {
    const double value = t.number(key, -most, most);
    if (!(value > 0)) t.refuse(key, "must be greater than 0");
    return value;
}

PlanScan scan_from(const TomlReader& t) {
    PlanScan scan;
    scan.name = t.text("name", longest_text);
    scan.sha256 = t.text("sha256", longest_text);
    try {
        scan.unit = unit_named(t.text("units"));
    } catch (const InputError& e) {
        t.refuse("units", e.what());
    }
    scan.scale = positive(t, "scale");
    scan.centre = t.vector("centre_mm", -most, most);
    scan.faces = t.whole("faces", 1, max_count);
    scan.volume_mm3 = positive(t, "volume_mm3");
    scan.box = {t.vector("box_min_mm", -most, most), t.vector("box_max_mm", -most, most)};
    return scan;
}

// Names cuts before the cut `number`.
std::vector<PathSide> path_from(const TomlReader& t, std::int32_t number) {
    std::vector<PathSide> path;
    for (const std::string& text : t.texts("path")) {
        std::istringstream in(text);
        PathSide side;
        std::string where;
        std::string rest;
        const bool is_ok = (in >> side.cut >> where) && !(in >> rest) && (where == "above" || where == "below") &&
                           side.cut >= 1 && side.cut < number;
        if (!is_ok) t.refuse("path", "\"" + text + "\" is not like \"1 above\", of an earlier cut");
        side.above = where == "above";
        path.push_back(side);
    }
    return path;
}

// As it was before the cut `number`.
PlanPiece piece_from(const TomlReader& t, std::int32_t number) {
    return {t.text("piece", longest_text), path_from(t, number), t.vector("inside_mm", -most, most),
            positive(t, "volume_mm3")};
}

PlanCut cut_from(const TomlReader& t, std::int32_t expected, Vec3 centre) {
    if (t.whole("number", 1, max_count) != static_cast<std::uint32_t>(expected)) {
        t.refuse("number", "must count 1, 2, ... in the order of the cuts");
    }
    PlanCut cut{piece_from(t, expected), expected, {}, 0, {}};
    const Vec3 normal = t.vector("normal", -most, most);
    if (!(norm(normal) > 0)) t.refuse("normal", "must not be zero");
    const Plane direction = canonical({normal, 0});
    const double turned = dot(direction.normal, normal) < 0 ? -1 : 1;
    cut.plane = {direction.normal, turned * t.number("offset_mm", -most, most)};
    cut.from_centre = cut.plane.offset - height(cut.plane.normal, centre);
    if (t.has("offset_from_centre_mm")) {
        const double exact = turned * t.number("offset_from_centre_mm", -most, most);
        if (std::abs(exact - cut.from_centre) > 1e-6) {
            t.refuse("offset_from_centre_mm", "is of another plane than offset_mm; delete the line to move the plane");
        }
        cut.from_centre = exact;
    }
    cut.makes_mm3 = t.numbers("makes_mm3", -most, most);
    return cut;
}

std::vector<PlanCut> cuts_from(const TomlReader& plan, Vec3 centre) {
    std::vector<PlanCut> cuts;
    if (!plan.has("cut")) return cuts;
    for (const TomlReader& t : plan.tables("cut", cut_keys)) {
        cuts.push_back(cut_from(t, static_cast<std::int32_t>(cuts.size()) + 1, centre));
    }
    return cuts;
}

std::vector<PlanDiscard> discards_from(const TomlReader& plan, std::size_t cuts) {
    std::vector<PlanDiscard> discards;
    if (!plan.has("discard")) return discards;
    std::uint32_t after = 0;
    for (const TomlReader& t : plan.tables("discard", discard_keys)) {
        after = t.whole("after", after, static_cast<std::uint32_t>(cuts));
        const auto number = static_cast<std::int32_t>(after);
        discards.push_back({piece_from(t, number + 1), number});
    }
    return discards;
}

Plan plan_from(const TomlReader& top) {
    if (top.whole("schema", 1, max_count) != schema) top.refuse("schema", "this version reads schema 1");
    Plan plan;
    plan.scan = scan_from(top.table("scan", scan_keys));
    const TomlReader w = top.table("weights", weight_keys);
    for (std::size_t i = 0; i < all_objectives.size(); ++i) {
        const ObjectiveField& field = all_objectives[i];
        const bool is_old = i < always_named;
        plan.weights.*field.weight = is_old || w.has(field.key) ? w.number(field.key, is_old ? -most : 0, most) : 0;
    }
    plan.cuts = cuts_from(top, plan.scan.centre);
    plan.discards = discards_from(top, plan.cuts.size());
    return plan;
}

}  // namespace

std::string to_text(const Plan& plan) {
    const PlanScan& s = plan.scan;
    std::ostringstream out;
    out << first_line << ": the cuts of a segmentation, to be made again on another version of the same specimen\n"
        << "# (docs/user/plan-file.md).\n"
        << "# Lengths are millimetres in the scan's own frame: coordinates of its file times unit and scale.\n"
        << "schema = " << schema << "\n\n[scan]\nname = " << quoted(s.name) << "\nsha256 = " << quoted(s.sha256)
        << "\nunits = " << quoted(name_of(s.unit)) << "\nscale = " << in_digits(s.scale)
        << "\ncentre_mm = " << in_digits(s.centre) << "\nfaces = " << s.faces
        << "\nvolume_mm3 = " << in_digits(s.volume_mm3) << "\nbox_min_mm = " << in_digits(s.box.min)
        << "\nbox_max_mm = " << in_digits(s.box.max) << "\n\n[weights]\n";
    for (std::size_t i = 0; i < all_objectives.size(); ++i) {
        const double weight = plan.weights.*all_objectives[i].weight;
        if (i < always_named || weight > 0) out << all_objectives[i].key << " = " << in_digits(weight) << "\n";
    }
    for (const PlanCut& cut : plan.cuts) {
        out << "\n[[cut]]\nnumber = " << cut.number << "\npiece = " << quoted(cut.piece)
            << "\npath = " << describe(cut.path) << "\nnormal = " << in_digits(cut.plane.normal)
            << "\noffset_mm = " << in_digits(cut.plane.offset)
            << "\noffset_from_centre_mm = " << in_digits(cut.from_centre) << "\ninside_mm = " << in_digits(cut.inside)
            << "\nvolume_mm3 = " << in_digits(cut.volume_mm3) << "\nmakes_mm3 = [";
        for (std::size_t i = 0; i < cut.makes_mm3.size(); ++i) {
            out << (i > 0 ? ", " : "") << in_digits(cut.makes_mm3[i]);
        }
        out << "]\n";
    }
    for (const PlanDiscard& discard : plan.discards) {
        out << "\n[[discard]]\nafter = " << discard.after << "\npiece = " << quoted(discard.piece)
            << "\npath = " << describe(discard.path) << "\ninside_mm = " << in_digits(discard.inside)
            << "\nvolume_mm3 = " << in_digits(discard.volume_mm3) << "\n";
    }
    return out.str();
}

Plan plan_from_text(std::string_view text, const std::string& file) {
    try {
        return plan_from(TomlReader::parse(text, file, plan_keys));
    } catch (const InputError& e) {  // the remedies of TomlReader are those of a cell file
        throw InputError(InputFault::config, e.what(), "correct the plan; docs/user/plan-file.md explains its keys");
    }
}

Plan read_plan(const std::filesystem::path& file) {
    const Bytes text = read_file(file, record_limit);
    return plan_from_text({reinterpret_cast<const char*>(text.data()), text.size()}, file.string());
}

bool has_plan_header(std::string_view text) {
    return text.starts_with(first_line);
}

}  // namespace qchopper
