// Prints the JSON schema of a document.

#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/jobs/verdict_schema.h"
#include "app/store/project_json.h"
#include "cam/job/document_schemas.h"

namespace qchopper {
namespace {

std::string schema_of(const std::string& document) {
    if (document == "manifest") return manifest_schema();
    if (document == "envelope") return envelope_schema();
    if (document == "ticket") return ticket_schema();
    if (document == "verdict") return verdict_schema();
    return project_schema();
}

}  // namespace

int run(const SchemaArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("Nothing was changed.");
    const std::string text = schema_of(arguments.document);
    terminal.show({text.substr(0, text.size() - 1)}, compose(nlohmann::ordered_json::parse(text)));
    return exit_done;
}

}  // namespace qchopper
