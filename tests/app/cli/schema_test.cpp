// The schemas that the program prints.

#include <gtest/gtest.h>

#include "app/cli/exit_code.h"
#include "app/jobs/verdict_schema.h"
#include "app/store/project_json.h"
#include "cam/job/document_schemas.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

TEST(SchemaCommand, PrintsTheSchemaOfEachDocument) {
    const program::Folder folder;
    for (const auto& [name, schema] : {std::pair{"manifest", manifest_schema()},
                                       {"envelope", envelope_schema()},
                                       {"ticket", ticket_schema()},
                                       {"verdict", verdict_schema()},
                                       {"project", project_schema()}}) {
        const program::Ended ended = program::run({"schema", name}, {folder.path});
        EXPECT_EQ(ended.code, exit_done) << ended.err;
        EXPECT_EQ(ended.out, schema);
    }
    EXPECT_EQ(program::run({"schema", "sheet"}, {folder.path}).code, exit_use);
    EXPECT_EQ(program::run({"--help"}, {folder.path}).out.find("schema"), std::string::npos);
}

}  // namespace
}  // namespace qchopper
