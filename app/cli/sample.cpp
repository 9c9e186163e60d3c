#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/cli/segment_project.h"
#include "base/text.h"
#include "segment/import/inspect.h"
#include "segment/io/write_ply.h"
#include "segment/io/write_stl.h"
#include "segment/mesh/measure.h"
#include "segment/sample/sample.h"

namespace qchopper {

int run(const SampleArguments& arguments, Terminal& terminal) {
    const bool is_stl = arguments.out.extension() == ".stl";
    if (!is_stl && arguments.out.extension() != ".ply") {
        throw InputError(InputFault::use, arguments.out.string() + " ends neither in .ply nor in .stl",
                         "name a .ply file");
    }
    check_output(arguments.out);
    SampleOptions options;
    options.faces = arguments.faces;
    options.holes = arguments.holes;
    options.marks = arguments.marks;
    DrawnMarks drawn;
    const TriangleMesh mesh = sample(*specimen_named(arguments.specimen), options, terminal.context(), &drawn);
    write_file(arguments.out, is_stl ? to_stl(mesh) : to_ply(mesh));
    const std::string size = size_in_words(bounds(mesh).size());
    terminal.show(arguments.out.string() + ": " + arguments.specimen + ", " + with_commas(mesh.triangles.size()) +
                  " faces, " + size + ", in mm");
    if (arguments.marks > 0) {
        terminal.show(std::to_string(drawn.lines.size()) + " marks, " + fixed(drawn.width, 1) + " mm wide and " +
                      fixed(drawn.depth, 2) + " mm deep");
    }
    terminal.json(nlohmann::ordered_json{
        {"schema", "qchopper-sample-1"},
        {"specimen", arguments.specimen},
        {"file", arguments.out.string()},
        {"faces", mesh.triangles.size()},
        {"vertices", mesh.points.size()},
        {"holes", arguments.holes},
        {"marks", drawn.lines.size()},
        {"mark_width_mm", drawn.width},
        {"mark_depth_mm", drawn.depth},
        {"units", "mm"},
        {"size",
         size}}.dump(1));
    return exit_done;
}

}  // namespace qchopper
