// The schemas of manifest, envelope and ticket: real documents are valid, damaged ones are not, and the page of
// the format has the keys of the tables.

#include "cam/job/document_schemas.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "cam/job/manifest.h"
#include "cam/job/read_job.h"
#include "cam/job/write_job.h"
#include "tests/cam/job/some_job.h"
#include "tests/json_schema.h"

namespace qchopper {
namespace {

using namespace test_pieces;
using Names = std::set<std::string>;

// With a robot program, a joint with two holes and what else a manifest may have.
JobInput job_with_all() {
    JobInput input = tilting_job(3);
    input.caps = {capped(input, 2)};
    ProgramInput program;
    program.program.entry = "qc_2.src";
    program.program.files = {"qc_2.src"};
    program.program.chunks = {{"qc_2.src", 1, 0, 120, 4567.25, {{-1, -2, 0}, {3, 4, 60}}, {0, 0, 60}, {1, 1, 60}}};
    program.program.drilling = {{{0, 0, 1}, 0.5}};
    program.program.left_out = {{1, std::nullopt, "tool 2 roughs"}, {std::nullopt, 2, "nothing is left"}};
    program.texts["qc_2.src"] = "DEF qc_2\r\nEND\r\n";
    program.tools = {1, 7};
    input.program = program;
    for (JobHole& hole : input.caps[0].cap.joints[0].holes) hole.by_hand = "no drill of 8 mm";
    return input;
}

const std::vector<JobInput>& some_jobs() {
    static const std::vector<JobInput> jobs{some_job(3), sawn_job(), placed_job(), job_with_all()};
    return jobs;
}

SchemaJson manifest_of(const JobInput& input) {
    return SchemaJson::parse(to_manifest(input, {{"piece.stl", 84, {}}}));
}

TEST(DocumentSchemas, RealDocumentsAreValid) {
    for (const JobInput& input : some_jobs()) {
        const ReadJob job = parse_job(job_file(input), "AB.qjob");
        const std::vector<std::string> none;
        EXPECT_EQ(schema_faults(SchemaJson::parse(manifest_schema()), manifest_of(input)), none);
        EXPECT_EQ(schema_faults(SchemaJson::parse(envelope_schema()),
                                SchemaJson::parse(text_of(job.files.at("envelope.json")))),
                  none);
        EXPECT_EQ(
            schema_faults(SchemaJson::parse(ticket_schema()), SchemaJson::parse(text_of(job.files.at("ticket.json")))),
            none);
    }
}

// Calls visit(place) for every value in a document, so that it may be changed there and changed back.
void for_each_value(SchemaJson& value, const std::function<void(SchemaJson&)>& visit) {
    visit(value);
    if (!value.is_structured()) return;
    for (SchemaJson& part : value) for_each_value(part, visit);
}

// Every value once as another kind, every key once missing, and every object once with a key too many.
TEST(DocumentSchemas, AWrongKindAMissingKeyAndAKeyTooManyAreRefusedByTheSchema) {
    const SchemaJson schema = SchemaJson::parse(manifest_schema());
    const Names optional = keys_of_schema(schema, true);
    EXPECT_EQ(optional,
              (Names{"allowed_mm2", "flush_caps", "foam_at_faces_mm", "ignored_mm2", "milled_caps_mm2", "restart"}));
    std::size_t changes = 0;
    for (const JobInput& input : some_jobs()) {
        SchemaJson document = manifest_of(input);
        const auto expect_refused = [&](const std::string& change) {
            EXPECT_NE(schema_faults(schema, document), std::vector<std::string>()) << change;
            ++changes;
        };
        for_each_value(document, [&](SchemaJson& place) {
            const SchemaJson kept = place;
            place = kept.is_boolean() ? SchemaJson("true") : SchemaJson(true);
            expect_refused("another kind: " + kept.dump());
            place = kept;
            if (!kept.is_object()) return;
            place["unknown"] = 1;
            expect_refused("a key too many: " + kept.dump());
            for (const auto& [key, part] : kept.items()) {
                place = kept;
                place.erase(key);
                if (!optional.contains(key)) expect_refused("missing: " + key);
            }
            place = kept;
        });
        EXPECT_EQ(document, manifest_of(input));
    }
    EXPECT_GT(changes, 1500U);
}

TEST(DocumentSchemas, AValueOutOfRangeIsRefused) {
    const SchemaJson schema = SchemaJson::parse(manifest_schema());
    const auto is_valid = [&](const std::function<void(SchemaJson&)>& change) {
        SchemaJson document = manifest_of(some_jobs().back());
        change(document);
        return schema_faults(schema, document).empty();
    };
    EXPECT_TRUE(is_valid([](SchemaJson&) {}));
    EXPECT_FALSE(is_valid([](SchemaJson& j) { j["schema"] = 7; }));
    EXPECT_FALSE(is_valid([](SchemaJson& j) { j["stock"]["material"] = "oak"; }));
    EXPECT_FALSE(is_valid([](SchemaJson& j) { j["piece"]["number"] = 65536; }));
    EXPECT_FALSE(is_valid([](SchemaJson& j) { j["piece"]["number"] = -1; }));
    EXPECT_FALSE(is_valid([](SchemaJson& j) { j["max_unreachable"] = -0.5; }));
    EXPECT_FALSE(is_valid([](SchemaJson& j) { j["scan_sha256"] = "00"; }));
    EXPECT_FALSE(is_valid([](SchemaJson& j) { j["setup"]["up"].push_back(1); }));
    EXPECT_FALSE(is_valid([](SchemaJson& j) { j["setup"]["up"].erase(0); }));
}

TEST(DocumentSchemas, TheGrammarOfThePageHasTheKeysOfTheTables) {
    expect_keys_of_page("job-folder.md", "manifest    = ", {manifest_schema(), envelope_schema(), ticket_schema()},
                        {"manifest", "ticket", "envelope", "object", "null", "or", "z", "a", "f"});
}

}  // namespace
}  // namespace qchopper
