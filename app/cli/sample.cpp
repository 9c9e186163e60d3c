// Makes a synthetic specimen.

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/report/notices.h"
#include "app/store/project_folder.h"
#include "base/timings.h"
#include "segment/io/write_mesh.h"

namespace qchopper {

int run(const SampleArguments& arguments, Terminal& terminal) {
    check_mesh_name(arguments.out);
    check_output(arguments.out);
    SampleOptions options;
    options.faces = arguments.faces;
    options.holes = arguments.holes;
    options.pen_grooves = arguments.pen_grooves;
    WrittenSample made{arguments.specimen, arguments.out.string(), arguments.holes, {}, {}};
    const Context context = terminal.context();
    StageTimer stage(context, "specimen made");
    made.mesh = sample(*specimen_named(arguments.specimen), options, context, &made.pen_grooves);
    stage.next("mesh written");
    write_mesh(arguments.out, made.mesh);
    terminal.show(lines(made), document(made));
    return exit_done;
}

}  // namespace qchopper
