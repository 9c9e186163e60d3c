// Makes the programs of a shard of a project's pieces, and writes the jobs with those that were made.

#include "app/cli/arguments/option_values.h"
#include "app/cli/arguments/version.h"
#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/engine/work_project.h"
#include "app/report/prepare_report.h"
#include "app/report/program_report.h"
#include "app/store/project_folder.h"
#include "base/error.h"
#include "base/files/file.h"
#include "base/printable.h"
#include "base/text.h"
#include "cam/job/glue_faces.h"

namespace qchopper {

int run(const WorkArguments& a, Terminal& terminal) {
    terminal.set_unchanged("The project is unchanged.");
    std::vector<std::filesystem::path> inputs;
    inputs.reserve(a.inputs.size());
    for (const std::filesystem::path& input : a.inputs) inputs.push_back(without_slash(input));
    WorkOptions options;
    if (a.shard) options.shard = *shard_from(*a.shard);
    options.has_retry = a.has_retry;
    const auto tell = [&](const WorkedPiece& piece) { terminal.message(worked_line(piece)); };
    const WorkAnswer answer =
        a.status ? work_done(inputs, version()) : work_items(inputs, options, version(), tell, terminal.context());
    terminal.show(lines(answer), document(answer));
    if (a.status || answer.unmade.empty()) return exit_done;
    std::vector<std::string> names;
    for (const UnmadePiece& piece : answer.unmade) names.push_back(piece.piece);
    terminal.warn(
        {"three attempts have failed to make " + list_of_pieces(names) + ", which is left out; --retry tries again"});
    return exit_demand_broken;
}

int run(const GatherArguments& a, Terminal& terminal) {
    terminal.set_unchanged("The project is unchanged.");
    const std::filesystem::path folder = without_slash(a.project);
    return show(gather_project(folder, a.make_missing, version(), terminal.context()), folder, terminal);
}

int show(const GatherAnswer& answer, const std::filesystem::path& project, Terminal& terminal) {
    const std::filesystem::path failed = project / "work" / "failed.jsonl";
    std::error_code error;
    std::filesystem::remove(failed, error);
    if (answer.prepared) return show(*answer.prepared, terminal);
    for (const WorkedPiece& piece : answer.refused) terminal.warn({refused_line(piece)});
    const std::string name = shell_word(project);
    if (!answer.unmade.empty()) {
        write_file(failed, json_lines(answer.unmade));
        std::vector<std::string> missing;
        for (const UnmadePiece& piece : answer.unmade) {
            missing.push_back(piece.piece);
            terminal.warn({unmade_line(piece)});
        }
        throw InputError(InputFault::missing,
                         "no whole result of " + counted(missing.size(), "piece") + ": " + list_of_pieces(missing) +
                             "; work/failed.jsonl says what is known of them",
                         "make them: qchopper work " + name + ", or gather with --make-missing");
    }
    const std::string next =
        "Next: qchopper prepare " + name + " --items, which changes these pieces, then qchopper submit " + name +
        " or qchopper work " + name + "; or qchopper gather " + name + " --make-missing, which does it all here";
    terminal.show({"Programs that are proven are kept.", next}, document(work_done({project}, version())));
    return exit_demand_broken;
}

}  // namespace qchopper
