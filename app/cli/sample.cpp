#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/project/project_folder.h"
#include "app/report/notices.h"
#include "segment/io/write_ply.h"
#include "segment/io/write_stl.h"

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
    WrittenSample made{arguments.specimen, arguments.out.string(), arguments.holes, {}, {}};
    made.mesh = sample(*specimen_named(arguments.specimen), options, terminal.context(), &made.marks);
    write_file(arguments.out, is_stl ? to_stl(made.mesh) : to_ply(made.mesh));
    terminal.show(lines(made));
    terminal.json(document(made));
    return exit_done;
}

}  // namespace qchopper
