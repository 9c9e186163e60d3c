// The schema for editors has the keys that the reader knows, table by table.

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>

#include "cam/cell/cell_keys.h"

namespace qchopper {
namespace {

using nlohmann::json;
using Names = std::set<std::string>;
using Tables = std::map<std::string, Names>;  // keys by the path of the table

// Of a table of the schema and of all tables in it.
void add_tables(const json& schema, const std::string& path, Tables& tables) {
    EXPECT_EQ(schema["additionalProperties"], false) << path;
    Names& names = tables[path];
    for (const auto& [key, value] : schema["properties"].items()) {
        names.insert(key);
        const json& inner = value.contains("items") ? value["items"] : value;
        if (inner.contains("properties")) add_tables(inner, path.empty() ? key : path + "." + key, tables);
    }
    for (const json& key : schema["required"]) EXPECT_TRUE(names.contains(key)) << path << ": " << key;
}

Names names_of(Keys keys) {
    return {keys.begin(), keys.end()};
}

void expect_same(const std::string& version, std::span<const TableKeys> known) {
    std::ifstream stream(QCHOPPER_SOURCE_DIR "/docs/cell-file.schema.json");
    const json schema = json::parse(stream);
    Tables in_schema;
    add_tables(schema["definitions"][version], "", in_schema);
    Tables in_reader;
    for (const TableKeys& table : known) {
        const std::string path(table.path);
        EXPECT_FALSE(in_reader.contains(path)) << path;
        in_reader[path] = names_of(table.keys);
        if (in_reader[path].contains("sources")) in_reader[path + ".sources"] = names_of(table.with_origin());
    }
    EXPECT_EQ(in_schema, in_reader);
}

TEST(CellSchema, HasTheKeysOfTheReader) {
    expect_same("version_1", keys_1::all);
    expect_same("version_2", keys_2::all);
}

}  // namespace
}  // namespace qchopper
