#include <nlohmann/json.hpp>

#include "cam/job/text.h"
#include "cli/commands.h"
#include "cli/exit_code.h"
#include "segment/intake/inspect.h"
#include "segment/intake/intake.h"

namespace qchopper {
namespace {

using Json = nlohmann::ordered_json;

std::string verdict(const Inspection& i) {
    if (i.triangles == 0) return "no faces: cannot be used";
    if (i.non_manifold > 0) return "more than two faces meet at an edge: cannot be closed as it is";
    if (i.inconsistent > 0) return "neighbouring faces are turned against each other: cannot be used as it is";
    if (i.open_edges > 0) return "open: prepare fills the holes";
    return "closed: ready";
}

std::vector<std::string> lines(const InspectArguments& arguments, const Inspection& i) {
    const std::string unit = arguments.units.value_or("unit");
    const Vec3 size = i.box.size();
    std::vector<std::string> text;
    text.push_back(arguments.scan.string() + ": " + name_of(i.format));
    text.push_back("faces        " + with_commas(i.triangles));
    text.push_back("vertices     " + with_commas(i.vertices));
    if (arguments.units)
        text.push_back("size         " + size_in_words(mm_per(unit_named(*arguments.units)) * size));
    else
        text.push_back("size         " + fixed(size.x, 4) + " x " + fixed(size.y, 4) + " x " + fixed(size.z, 4) +
                       " (the file has no unit: say --units)");
    text.push_back("shells       " + with_commas(i.shells) + " (" + with_commas(i.cavities) + " cavities, " +
                   with_commas(i.inside_out) + " inside out)");
    text.push_back("open edges   " + with_commas(i.open_edges) + " in " + with_commas(i.holes.size()) + " holes");
    text.push_back("volume       " + fixed(i.volume, 6) + " " + unit + "^3" + (i.is_closed() ? "" : " (not closed)"));
    text.push_back("area         " + fixed(i.area, 6) + " " + unit + "^2");
    const std::pair<const char*, std::size_t> faults[] = {
        {"edges of more than two faces", i.non_manifold},
        {"edges with faces turned against each other", i.inconsistent},
        {"points where surfaces only touch", i.pinched},
        {"faces collapsed to a line or point", i.collapsed},
        {"faces without area", i.no_area},
        {"points in no face", i.unreferenced}};
    for (const auto& [what, count] : faults) {
        if (count > 0) text.push_back("             " + with_commas(count) + " " + what);
    }
    text.push_back("verdict      " + verdict(i));
    return text;
}

Json document(const InspectArguments& arguments, const Inspection& i) {
    Json holes = Json::array();
    for (const BorderLoop& hole : i.holes) {
        holes.push_back({{"edges", hole.edges}, {"centre", {hole.centre.x, hole.centre.y, hole.centre.z}}});
    }
    const Vec3 size = i.box.size();
    Json json{{"schema", "qchopper-inspect-1"},
              {"file", arguments.scan.string()},
              {"format", name_of(i.format)},
              {"faces_in_file", i.faces_in_file},
              {"vertices_in_file", i.points_in_file},
              {"faces", i.triangles},
              {"vertices", i.vertices},
              {"units", arguments.units ? Json(*arguments.units) : Json()},
              {"size", {size.x, size.y, size.z}},
              {"min", {i.box.min.x, i.box.min.y, i.box.min.z}},
              {"max", {i.box.max.x, i.box.max.y, i.box.max.z}},
              {"shells", i.shells},
              {"cavities", i.cavities},
              {"inside_out", i.inside_out},
              {"closed", i.is_closed()},
              {"open_edges", i.open_edges},
              {"holes", holes},
              {"non_manifold_edges", i.non_manifold},
              {"inconsistent_edges", i.inconsistent},
              {"pinched_vertices", i.pinched},
              {"collapsed_faces", i.collapsed},
              {"faces_without_area", i.no_area},
              {"unreferenced_vertices", i.unreferenced},
              {"volume", i.volume},
              {"area", i.area},
              {"verdict", verdict(i)}};
    if (arguments.units) json["size_in_words"] = size_in_words(mm_per(unit_named(*arguments.units)) * size);
    return json;
}

}  // namespace

int run(const InspectArguments& arguments, Terminal& terminal) {
    terminal.unchanged = "Nothing was changed.";
    const Inspection inspection = inspect(read_mesh(arguments.scan));
    for (const std::string& line : lines(arguments, inspection)) terminal.show(line);
    terminal.json(document(arguments, inspection).dump(1, ' ', false, Json::error_handler_t::replace));
    return exit_done;
}

}  // namespace qchopper
