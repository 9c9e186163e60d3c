// Explains a cut by the candidates that were ranked for it, with a plot of their values.

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/report/explanation.h"
#include "app/store/project_folder.h"
#include "base/files/file.h"

namespace qchopper {
namespace {

std::filesystem::path picture_path(const ExplainArguments& a, std::int32_t cut) {
    if (!a.out) return a.project / "pictures" / ("cut-" + std::to_string(cut) + ".svg");
    if (a.out->extension() != ".svg") {
        throw InputError(InputFault::use, a.out->string() + " does not end in .svg", "name a .svg file");
    }
    return *a.out;
}

}  // namespace

int run(const ExplainArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("The project is unchanged.");
    Context context = terminal.context();
    context.on_message = nullptr;
    OpenProject open(arguments.project, context);
    const Cut cut = cut_to_explain(open.project(), arguments.cut);
    const std::filesystem::path picture = picture_path(arguments, cut.number);
    const Explanation e = explain(open, cut, context);
    terminal.warn(warnings(e));
    write_file(picture, to_svg(plot(e, without_slash(arguments.project).filename().string())));
    terminal.show(lines(e, open.project(), picture.string()), document(e, open.project(), picture.string()));
    return exit_done;
}

}  // namespace qchopper
