// Every tool takes, from the largest on, the surface that it finishes (finishing_region.h). A tool stays if the next
// one would take longer for that surface than changing the tool does. O(tools * directions * cells).

#include "cam/toolpath/worthwhile_tools.h"

#include <algorithm>

#include "cam/setup/holder_clearance.h"
#include "cam/stock/cl_surface.h"
#include "cam/toolpath/finishing/finishing_region.h"
#include "cam/toolpath/finishing/scallop.h"
#include "cam/toolpath/finishing_limit.h"

namespace qchopper {
namespace {

constexpr double judged_cell = 0.5;
constexpr double judged_spacing = 2;  // of points on the surface
// What passes take beyond area over stepover at full feed, measured on pieces of the bunny at 1.5 m and of a vertebra
// of 0.14 m: rims, closer passes on slopes, acceleration; and where others were before, patches with what lies around
// them.
constexpr double milled_in_bulk = 2.5;
constexpr double milled_around = 4;
constexpr double change_s = 75;  // of a tool by a person, with the ways home and back

// mm2 of surface of which each tool finishes what those before it do not, and mm2 of all.
struct FinishedAreas {
    std::vector<double> of_tool;
    double all = 0;
};

FinishedAreas finished_areas(const Setup& setup, const TriangleMesh& mesh, const CellMachine& machine,
                             const std::vector<std::size_t>& tools, double scallop, const Context& context) {
    RestMaterial left(mesh, setup, judged_spacing);
    FinishedAreas areas;
    areas.all = left.area_mm2();
    double before = 0;
    for (const std::size_t index : tools) {
        const CuttingTool& tool = machine.tools[index];
        for (std::size_t d = 0; d < setup.access.orientations.size(); ++d) {
            context.check_cancelled();
            const double floor_z = finishing_floor(setup, setup.tool_axis(d), 0.5 * tool.diameter);
            const HeightField piece = piece_height_field(setup, mesh, d, {judged_cell, floor_z, tool.diameter});
            const double near = scallop + judged_cell;
            const auto cells = [](double length) { return static_cast<std::size_t>(length / judged_cell) + 2; };
            const FieldTiles surface = left.places(piece, near).grown(cells(RestMaterial::examined(near)));
            HeightField cl = cl_surface(ToolDilation(piece, tool), surface.grown(cells(0.5 * tool.diameter)));
            raise_to_holder(cl, piece, tool_body(tool, machine), setup.piece_in_setup);
            left.take(remaining_surface(cl, tool, surface), near, 0, 0, true);
        }
        const double finished = areas.all * left.share_within(0);
        areas.of_tool.push_back(finished - before);
        before = finished;
    }
    return areas;
}

// s/mm2 at full feed.
double time_per_area(const CuttingTool& tool, double scallop) {
    return 1 / (chord_for_scallop(0.5 * tool.diameter, scallop) * tool.feed_max_mm_per_s);
}

}  // namespace

std::vector<std::size_t> worthwhile_tools(const Setup& setup, const TriangleMesh& mesh, const Cell& cell,
                                          const std::vector<std::size_t>& tools, const ToolpathSettings& settings,
                                          const Context& context) {
    if (tools.size() < 2 || settings.fine == FineTools::all) return tools;
    const CellMachine& machine = *cell.machine;
    FinishedAreas areas = finished_areas(setup, mesh, machine, tools, settings.scallop, context);
    std::size_t count = tools.size();
    double left_out = 0;
    while (count > 1) {
        left_out += areas.of_tool[count - 1];
        if (left_out >= worthwhile_share * areas.all) break;
        --count;
    }
    std::vector<std::size_t> worthwhile;
    for (std::size_t i = 0; i < count; ++i) {
        const bool is_last = i + 1 == count;
        const double around = worthwhile.empty() ? milled_in_bulk : milled_around;
        const double gained = is_last ? 0
                                      : around * areas.of_tool[i] *
                                            (time_per_area(machine.tools[tools[i + 1]], settings.scallop) -
                                             time_per_area(machine.tools[tools[i]], settings.scallop));
        if (is_last || gained > change_s) {
            worthwhile.push_back(tools[i]);
        } else {
            areas.of_tool[i + 1] += areas.of_tool[i];
        }
    }
    return worthwhile;
}

}  // namespace qchopper
