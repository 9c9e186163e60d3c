// project.json: a project that is read, written and read again is the same project.

#include "app/store/project_json.h"
#include "tests/fuzz/demand.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace qchopper;
    const std::string text = text_of(data, size);
    or_refused(InputFault::config, [&] {
        const Project project = project_from_json(text, "project.json");
        demand(project.history.committed <= project.history.decisions.size());
        demand(project.cuts == committed_cuts(project.history));
        Project again;
        try {
            again = project_from_json(to_json(project), "written.json");
        } catch (const InputError&) {
            std::abort();
        }
        demand(again == project);
    });
    return 0;
}
