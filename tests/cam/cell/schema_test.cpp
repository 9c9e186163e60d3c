// The schema for editors has the keys that the reader knows, table by table.

#include <gtest/gtest.h>

#include <cctype>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <sstream>
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

void expect_same(std::span<const TableKeys> known) {
    std::ifstream stream(QCHOPPER_SOURCE_DIR "/docs/user/cell-file.schema.json");
    const json schema = json::parse(stream);
    Tables in_schema;
    add_tables(schema, "", in_schema);
    Tables in_reader;
    for (const TableKeys& table : known) {
        const std::string path(table.path);
        EXPECT_FALSE(in_reader.contains(path)) << path;
        in_reader[path] = names_of(table);
        if (in_reader[path].contains("sources")) in_reader[path + ".sources"] = names_of(table.with_origin());
    }
    EXPECT_EQ(in_schema, in_reader);
}

bool is_word_part(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// Whether the key stands in the text as a whole word.
bool has_word(const std::string& text, const std::string& key) {
    for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1)) {
        const bool begins = at == 0 || !is_word_part(text[at - 1]);
        const std::size_t end = at + key.size();
        if (begins && (end == text.size() || !is_word_part(text[end]))) return true;
    }
    return false;
}

TEST(CellPage, ExplainsEveryKey) {
    std::ifstream stream(QCHOPPER_SOURCE_DIR "/docs/user/cell-file.md");
    std::ostringstream bytes;
    bytes << stream.rdbuf();
    const std::string page = bytes.str();
    for (const TableKeys& table : keys_2::all) {
        for (const std::string_view key : Keys(table)) {
            EXPECT_TRUE(has_word(page, std::string(key))) << table.path << "." << key;
        }
    }
}

TEST(CellSchema, HasTheKeysOfTheReader) {
    expect_same(keys_2::all);
}

}  // namespace
}  // namespace qchopper
