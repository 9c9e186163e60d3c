// Prints the JSON schema of a document, or the table of commands.

#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/jobs/verdict_schema.h"
#include "app/report/report_json.h"
#include "app/store/project_json.h"
#include "cam/job/document_schemas.h"

namespace qchopper {

template <class V, Of<OptionRow> T>
void fields(V& v, T& row) {
    v("names", row.names);
    v("about", row.about);
    v("takes_value", row.takes_value);
    v("is_required", row.is_required);
}

template <class V, Of<CommandRow> T>
void fields(V& v, T& row) {
    v("command", row.command);
    v("about", row.about);
    v("arguments", row.arguments);
    v("options", row.options);
}

namespace {

std::string text_of_commands() {
    nlohmann::ordered_json table;
    table["commands"] = json_of(command_table());
    return table.dump(2) + "\n";
}

std::string schema_of(const std::string& document) {
    if (document == "manifest") return manifest_schema();
    if (document == "envelope") return envelope_schema();
    if (document == "ticket") return ticket_schema();
    if (document == "commands") return text_of_commands();
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
