#include "app/console/routes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace qchopper {
namespace {

// The path of a row with this for every id.
std::string path_of(const RouteRow& row, const std::string& id) {
    std::string path;
    for (const char c : row.path) path += c == '*' ? id : std::string(1, c);
    return path;
}

std::size_t ids_in(const RouteRow& row) {
    return static_cast<std::size_t>(std::ranges::count(row.path, '*'));
}

TEST(Routes, EveryRowIsMatchedByItsOwnPathAndByNoOther) {
    for (const RouteRow& row : route_rows()) {
        const RouteMatch match = match_route(row.method, path_of(row, "x1"));
        EXPECT_EQ(match.row, &row) << row.path;
        EXPECT_EQ(match.ids, std::vector<std::string>(ids_in(row), "x1")) << row.path;
        for (const RouteRow& other : route_rows()) {
            if (&other == &row || other.method != row.method) continue;
            EXPECT_NE(match_route(other.method, path_of(other, "x1")).row, &row) << row.path << " " << other.path;
        }
    }
}

TEST(Routes, NoTwoRowsHaveTheSameMethodAndPath) {
    std::set<std::pair<std::string_view, std::string_view>> seen;
    for (const RouteRow& row : route_rows()) {
        EXPECT_TRUE(seen.emplace(row.method, row.path).second) << row.path;
        EXPECT_TRUE(row.path.starts_with('/'));
        EXPECT_FALSE(row.about.empty());
    }
}

TEST(Routes, APathThatIsLongerShorterOrOtherwiseIsNotMatched) {
    for (const RouteRow& row : route_rows()) {
        const std::string path = path_of(row, "x1");
        for (const std::string& other :
             {path + "/", path + "//", path + "/x", "/" + path, path + " ", path.substr(1), path + "?", path + "#"}) {
            EXPECT_NE(match_route(row.method, other).row, &row) << other;
        }
        if (row.path.size() > 2) {
            EXPECT_NE(match_route(row.method, path.substr(0, path.size() - 3)).row, &row) << path;
        }
    }
    EXPECT_EQ(match_route("GET", "").row, nullptr);
    EXPECT_EQ(match_route("GET", "*").row, nullptr);
    EXPECT_EQ(match_route("GET", "http://127.0.0.1/api/state").row, nullptr);
    EXPECT_EQ(match_route("GET", "/API/state").row, nullptr);
}

TEST(Routes, AnIdIsNoPath) {
    const std::vector<std::string> wrong{"",
                                         ".",
                                         "..",
                                         "a/b",
                                         "a b",
                                         "a%41",
                                         "a\\b",
                                         "../..",
                                         "a\nb",
                                         "a?b",
                                         "a;b",
                                         "~",
                                         "a:b",
                                         "\xc3\xa4",
                                         "*",
                                         std::string(65, 'a'),
                                         std::string("a\0", 2)};
    const std::vector<std::string> right{"a", "A-_.9", "...", std::string(64, 'a'), "a..b", "-"};
    for (const RouteRow& row : route_rows()) {
        if (ids_in(row) == 0) continue;
        for (const std::string& id : wrong) EXPECT_NE(match_route(row.method, path_of(row, id)).row, &row) << id;
        for (const std::string& id : right) EXPECT_EQ(match_route(row.method, path_of(row, id)).row, &row) << id;
    }
}

TEST(Routes, AnotherMethodIsSaid) {
    for (const RouteRow& row : route_rows()) {
        const RouteMatch match = match_route("PATCH", path_of(row, "x1"));
        EXPECT_EQ(match.row, nullptr);
        EXPECT_TRUE(match.is_other_method) << row.path;
        EXPECT_EQ(match_route("get", path_of(row, "x1")).row, nullptr) << "methods are compared with case";
    }
    EXPECT_FALSE(match_route("GET", "/api/no/such/thing").is_other_method);
}

TEST(Routes, WhatChangesNothingTakesNoBody) {
    for (const RouteRow& row : route_rows()) {
        if (row.method != "POST") {
            EXPECT_EQ(row.body_bytes, 0U) << row.path;
        }
        if (row.method == "POST") {
            EXPECT_GT(row.body_bytes, 0U) << row.path;
        }
        EXPECT_LE(row.body_bytes, row.route == Route::make_project ? 1U << 20 : 1U << 16) << row.path;
        if (row.method != "GET") {
            EXPECT_NE(row.access, RouteAccess::open) << row.path;
        }
    }
}

}  // namespace
}  // namespace qchopper
