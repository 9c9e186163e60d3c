#include "app/console/page_files.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "app/console/routes.h"

namespace qchopper {
namespace {

const std::string page_folder = std::string(QCHOPPER_SOURCE_DIR) + "/app/console/page/dist/";

TEST(PageFiles, AreThoseOfTheFolderPacked) {
    for (const char* name : {"index.html", "page.js", "page.css", "three.js", "events.js", "NOTICES"}) {
        const std::optional<PageFile> file = page_file(name);
        ASSERT_TRUE(file) << name;
        ASSERT_GT(file->gzip.size(), 18U) << name;  // head and end of a gzip file
        EXPECT_EQ(file->gzip[0], '\x1f');
        EXPECT_EQ(file->gzip[1], '\x8b');
        EXPECT_TRUE(std::ifstream(page_folder + name)) << name;
    }
    EXPECT_EQ(page_file("")->gzip.data(), page_file("index.html")->gzip.data());
    EXPECT_EQ(page_file("page.js")->type, "text/javascript; charset=utf-8");
    for (const char* name : {"SOURCES.sha256", "README.md", "..", "page.jsx", "/etc/passwd"}) {
        EXPECT_FALSE(page_file(name)) << name;
    }
}

TEST(PageFiles, TheHashIsThatOfTheScript) {
    std::ifstream list(page_folder + "SOURCES.sha256");
    std::string line;
    bool is_found = false;
    while (std::getline(list, line)) {
        if (line.ends_with("dist/page.js")) is_found = line.starts_with(std::string(page_hash()));
    }
    EXPECT_TRUE(is_found);
}

TEST(PageFiles, ThePageOfTheRequestsNamesEachWithItsLimits) {
    std::ifstream file(std::string(QCHOPPER_SOURCE_DIR) + "/docs/developer/console.md");
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    for (const RouteRow& row : route_rows()) {
        const char* const whom = row.access == RouteAccess::open  ? "anyone"
                                 : row.access == RouteAccess::key ? "holder of the key"
                                                                  : "holder of the key, on this machine";
        const std::string body = row.body_bytes == 0             ? "none"
                                 : row.body_bytes == 1024 * 1024 ? "1 MB"
                                                                 : std::to_string(row.body_bytes / 1024) + " kB";
        const std::string line = "| `" + std::string(row.method) + " " + std::string(row.path) + "` | " + whom + " | " +
                                 (row.needs_revision ? "yes" : "no") + " | " + body + " | " + std::string(row.about) +
                                 " |\n";
        EXPECT_NE(text.find(line), std::string::npos) << "write to docs/developer/console.md: " << line;
    }
}

}  // namespace
}  // namespace qchopper
