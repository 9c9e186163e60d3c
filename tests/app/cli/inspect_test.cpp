// inspect as a process: what it prints, the document of docs/user/inspect.md, and that it touches nothing.

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "segment/io/write_mesh.h"
#include "tests/app/cli/program.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Inspect : ::testing::Test {
    program::Folder folder;
    program::Ended run(const program::Arguments& arguments) const { return program::run(arguments, {folder.path}); }
    json document(const program::Arguments& arguments) const {
        const program::Ended ended = run(arguments);
        EXPECT_EQ(ended.code, 0) << ended.err;
        return json::parse(ended.out);
    }
};

// Two boxes that run through each other; one lacks a face.
TriangleMesh bad() {
    TriangleMesh mesh =
        shapes::joined({shapes::box({0, 0, 0}, {40, 40, 40}, 2), shapes::box({30, 10, 10}, {60, 30, 30})});
    mesh.triangles.erase(mesh.triangles.begin());
    return mesh;
}

TEST_F(Inspect, DeepTellsWhereTheScanRunsThroughItself) {
    write_file(folder.path / "bad.ply", to_ply(bad()));
    const program::Contents before = program::contents(folder.path);
    const json quick = document({"inspect", "bad.ply", "--json"});
    EXPECT_TRUE(quick["self_intersections"].is_null());
    const json deep = document({"inspect", "bad.ply", "--deep", "--json", "--units", "mm"});
    EXPECT_EQ(deep["schema"], "qchopper-inspect-3");
    const json& found = deep["self_intersections"];
    EXPECT_GT(found["pairs"], 3);
    EXPECT_EQ(found["complete"], true);
    ASSERT_FALSE(found["places"].empty());
    for (const json& place : found["places"]) {
        EXPECT_GE(place[0], 30 - 1e-3);
        EXPECT_LE(place[0], 40 + 1e-3);
    }
    EXPECT_EQ(deep["open_edges"], 3);
    EXPECT_EQ(deep["longest_hole"]["edges"], 3);
    EXPECT_NEAR(deep["longest_hole"]["length"].get<double>(), 40 + std::sqrt(800.0), 1e-9);
    EXPECT_EQ(deep["verdict"], "to repair");
    EXPECT_EQ(deep["reasons"].size(), 2U);
    EXPECT_EQ(deep["units"], "mm");
    EXPECT_EQ(deep["size_text"], "60.0 mm x 40.0 mm x 40.0 mm");
    EXPECT_EQ(program::difference(before, program::contents(folder.path)), "");

    const std::string words = run({"inspect", "bad.ply", "--deep"}).out;
    EXPECT_NE(words.find("runs through itself at "), std::string::npos) << words;
    EXPECT_NE(words.find("verdict      to repair"), std::string::npos) << words;
}

TEST_F(Inspect, GivesTheThreeVerdicts) {
    write_file(folder.path / "ready.stl", to_stl(shapes::ball({0, 0, 0}, 50)));
    const json ready = document({"inspect", "ready.stl", "--deep", "--json"});
    EXPECT_EQ(ready["verdict"], "ready");
    EXPECT_EQ(ready["self_intersections"]["pairs"], 0);
    EXPECT_TRUE(ready["reasons"].empty());
    EXPECT_EQ(ready["welded_vertices"].get<std::size_t>() + ready["vertices"].get<std::size_t>(),
              ready["vertices_in_file"]);
    TriangleMesh open_component;
    open_component.points = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 1}};
    open_component.triangles = {{0, 1, 2}, {0, 2, 3}};
    write_file(folder.path / "sheet.ply", to_ply(open_component));
    EXPECT_EQ(document({"inspect", "sheet.ply", "--json"})["verdict"], "unrepairable");
}

// Every field of the document is a row of docs/user/inspect.md, and every row is a field.
TEST_F(Inspect, DocumentsEveryField) {
    write_file(folder.path / "bad.ply", to_ply(bad()));
    const json deep = document({"inspect", "bad.ply", "--deep", "--json"});
    std::set<std::string> fields;
    for (const auto& [name, value] : deep.items()) {
        fields.insert(name);
        if (name == "fragments" || name == "open_components" || name == "self_intersections") {
            for (const auto& [inner, unused] : value.items()) fields.insert(name + "." + inner);
        }
    }
    std::set<std::string> rows;
    std::istringstream page(program::bytes_in(fs::path(QCHOPPER_SOURCE_DIR) / "docs" / "user" / "inspect.md"));
    bool is_table = false;
    for (std::string line; std::getline(page, line);) {
        is_table |= line == "| field | meaning |";
        if (!is_table || line.rfind("| `", 0) != 0) continue;
        std::string names = line.substr(1, line.find('|', 1) - 1);
        for (std::size_t at = names.find('`'); at != std::string::npos; at = names.find('`')) {
            const std::size_t end = names.find('`', at + 1);
            rows.insert(names.substr(at + 1, end - at - 1));
            names.erase(0, end + 1);
        }
    }
    rows.insert({"fragments", "open_components"});  // told by their fields
    EXPECT_EQ(fields, rows);
}

TEST_F(Inspect, RefusesWhatIsNoScan) {
    program::put(folder.path / "empty.ply", "");
    EXPECT_EQ(run({"inspect", "empty.ply", "--deep", "--json"}).code, 65);
    EXPECT_EQ(run({"inspect", "nowhere.ply", "--deep", "--json"}).code, 66);
    EXPECT_EQ(run({"inspect", "empty.ply", "--deeper"}).code, 64);
}

}  // namespace
}  // namespace qchopper
