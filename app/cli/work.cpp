// Makes the programs of a shard of a project's pieces, and writes the jobs with those that were made.

#include "app/cli/arguments/option_values.h"
#include "app/cli/arguments/version.h"
#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/engine/prepare_project.h"
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
    const Shard shard = a.shard ? *shard_from(*a.shard) : Shard{};
    const auto tell = [&](const WorkedPiece& piece) { terminal.message(worked_line(piece)); };
    const WorkAnswer answer =
        a.status ? work_done(inputs, version()) : work_items(inputs, shard, version(), tell, terminal.context());
    terminal.show(lines(answer), document(answer));
    return exit_done;
}

int run(const GatherArguments& a, Terminal& terminal) {
    terminal.set_unchanged("The project is unchanged.");
    const std::filesystem::path folder = without_slash(a.project);
    const std::vector<UnmadePiece> unmade = take_results(folder, version(), terminal.context());
    const std::filesystem::path failed = folder / "work" / "failed.jsonl";
    if (unmade.empty()) {
        std::filesystem::remove(failed);
    } else {
        write_file(failed, json_lines(unmade));
    }
    if (!unmade.empty() && !a.make_missing) {
        std::vector<std::string> missing;
        for (const UnmadePiece& piece : unmade) {
            missing.push_back(piece.piece);
            terminal.warn({unmade_line(piece)});
        }
        throw InputError(InputFault::missing,
                         "no whole result of " + counted(missing.size(), "piece") + ": " + list_of_pieces(missing) +
                             "; work/failed.jsonl says what is known of them",
                         "make them: qchopper work " + shell_word(folder) + ", or gather with --make-missing");
    }
    PrepareOptions options{version(), {}};
    options.has_programs = true;
    return show(prepare_project(folder, {}, options, terminal.context()), terminal);
}

}  // namespace qchopper
