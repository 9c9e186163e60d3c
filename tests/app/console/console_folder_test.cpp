#include "app/console/console_folder.h"

#include <gtest/gtest.h>

#include <set>

#include "app/store/project_folder.h"
#include "base/error.h"
#include "base/files/file.h"
#include "tests/app/engine/planned.h"
#include "tests/folder.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

struct ConsoleFolder : ::testing::Test {
    Folder folder;
    const TriangleMesh mesh = shapes::stairs();

    void put(const std::string& name, std::string_view bytes = "ply\n") const { write_file(folder.path / name, bytes); }
    fs::path make_project(const std::string& name, int cuts = 0) const {
        const fs::path path = folder.path / name;
        create_project(path, planned::project_of(mesh, {}, cuts), {});
        return path;
    }
};

TEST_F(ConsoleFolder, ScansAndProjectsAreListedByName) {
    put("b.ply");
    put("a.STL", "solid");
    put("c.txt");
    put("d.ply.gz");
    put("e");
    fs::create_directory(folder.path / "folder.ply");
    make_project("two.qch", 2);
    make_project("one.qch");
    const FolderList list = list_folder(folder.path);
    ASSERT_EQ(list.scans.size(), 2U);
    EXPECT_EQ(list.scans[0].name, "a.STL");
    EXPECT_EQ(list.scans[0].bytes, 5U);
    EXPECT_EQ(list.scans[1].name, "b.ply");
    ASSERT_EQ(list.projects.size(), 2U);
    EXPECT_EQ(list.projects[0].name, "one.qch");
    EXPECT_EQ(list.projects[0].problem, "");
    EXPECT_EQ(list.projects[1].cuts, 2U);
    EXPECT_EQ(list.projects[1].pieces, load_project(folder.path / "two.qch").pieces.size());
    EXPECT_EQ(list.projects[1].scan, "bone.ply");
    EXPECT_FALSE(list.is_cut_off);
    EXPECT_NE(to_json(list), "");
}

TEST_F(ConsoleFolder, IdsLeadBackAndNameNoPath) {
    put("a.ply");
    const fs::path project = make_project("p.qch");
    const FolderList list = list_folder(folder.path);
    EXPECT_EQ(scan_of_id(folder.path, list.scans[0].id), folder.path / "a.ply");
    EXPECT_EQ(project_of_id(folder.path, list.projects[0].id), project);
    EXPECT_FALSE(scan_of_id(folder.path, list.projects[0].id)) << "a project is no scan";
    EXPECT_FALSE(project_of_id(folder.path, list.scans[0].id));
    for (const char* id : {"", "a.ply", "../a.ply", "..", "/etc/passwd", "p.qch"}) {
        EXPECT_FALSE(scan_of_id(folder.path, id)) << id;
        EXPECT_FALSE(project_of_id(folder.path, id)) << id;
    }
    EXPECT_EQ(list.scans[0].id.size(), 16U);
    fs::remove(folder.path / "a.ply");
    EXPECT_FALSE(scan_of_id(folder.path, list.scans[0].id));
}

TEST_F(ConsoleFolder, NamesWithMarkupAndControlBytesAreTextAndNothingMore) {
    const std::vector<std::string> names{"<img src=x onerror=alert(1)>.ply",
                                         "a\nb.ply",
                                         "\"quoted\\\".ply",
                                         "\xff\xfe.ply",
                                         "a\tb\x01.ply",
                                         "\xe2\x80\xaegnp.ply"};
    for (const std::string& name : names) put(name);
    make_project("<b>\n\xff.qch");
    const FolderList list = list_folder(folder.path);
    ASSERT_EQ(list.scans.size(), names.size());
    std::set<std::string> ids;
    for (const ListedScan& scan : list.scans) {
        ids.insert(scan.id);
        EXPECT_TRUE(scan_of_id(folder.path, scan.id)) << scan.name;
    }
    EXPECT_EQ(ids.size(), names.size());
    const std::string json = to_json(list);
    EXPECT_EQ(json.find('\n'), std::string::npos);
    EXPECT_EQ(json.find('\xff'), std::string::npos) << "JSON is UTF-8";
    ASSERT_EQ(list.projects.size(), 1U);
    const ProjectSummary summary = summary_of(*project_of_id(folder.path, list.projects[0].id));
    EXPECT_EQ(to_json(ProjectChange{summary, "page", "a\nb"}).find('\n'), std::string::npos)
        << "data of an event are one line";
}

TEST_F(ConsoleFolder, AThousandAreListedAndThatThereAreMoreIsSaid) {
    for (int i = 0; i < 1000; ++i) put("s" + std::to_string(1000 + i) + ".ply", "");
    EXPECT_FALSE(list_folder(folder.path).is_cut_off);
    put("t.ply", "");
    const FolderList list = list_folder(folder.path);
    EXPECT_TRUE(list.is_cut_off);
    EXPECT_EQ(list.scans.size(), 1000U);
    EXPECT_EQ(list.scans.front().name, "s1000.ply");
    EXPECT_TRUE(scan_of_id(folder.path, id_of_name("t.ply"))) << "what is not listed is found by its id";
}

TEST_F(ConsoleFolder, AProjectThatCannotBeReadIsListedWithTheReason) {
    const fs::path project = make_project("p.qch");
    const Bytes good = read_file(project / "project.json", record_limit);
    for (std::size_t size : {std::size_t{0}, std::size_t{1}, good.size() / 2, good.size() - 2}) {
        write_file(project / "project.json", std::string_view(reinterpret_cast<const char*>(good.data()), size));
        const FolderList list = list_folder(folder.path);
        ASSERT_EQ(list.projects.size(), 1U);
        EXPECT_NE(list.projects[0].problem, "") << size;
        EXPECT_THROW(summary_of(project), InputError);
    }
    fs::remove(project / "project.json");
    EXPECT_TRUE(list_folder(folder.path).projects.empty());
    fs::create_directory(project / "project.json");
    EXPECT_TRUE(list_folder(folder.path).projects.empty());
}

TEST_F(ConsoleFolder, WhatIsGoneLinkedOrLockedIsNoFault) {
    EXPECT_TRUE(list_folder(folder.path / "gone").scans.empty());
    fs::create_symlink(folder.path / "no such file", folder.path / "a.ply");
    fs::create_symlink(folder.path / "b.ply", folder.path / "b.ply");
    fs::create_directory_symlink(folder.path, folder.path / "round.qch");
    EXPECT_TRUE(list_folder(folder.path).scans.empty());
    EXPECT_TRUE(list_folder(folder.path).projects.empty());
}

TEST_F(ConsoleFolder, ASummaryNamesWhatUndoAndRedoWouldDo) {
    const fs::path path = make_project("p.qch", 2);
    const ProjectSummary summary = summary_of(path);
    EXPECT_EQ(summary.id, id_of_name("p.qch"));
    EXPECT_EQ(summary.stage, "cutting");
    EXPECT_EQ(summary.revision.size(), 16U);
    EXPECT_TRUE(summary.undo.starts_with("Undo cut 2 on piece ")) << summary.undo;
    EXPECT_EQ(summary.redo, "");
    EXPECT_FALSE(summary.writer);
    const ProjectLock lock(path);
    EXPECT_TRUE(summary_of(path).writer);
}

TEST_F(ConsoleFolder, AStampChangesWithEveryWriting) {
    const fs::path path = make_project("p.qch");
    std::set<std::uint64_t> stamps;
    for (int i = 0; i < 50; ++i) {
        save_project(path, load_project(path));
        stamps.insert(stamp_of(path));
    }
    EXPECT_EQ(stamps.size(), 50U);
    EXPECT_EQ(stamps.count(0), 0U);
    EXPECT_EQ(stamp_of(folder.path / "gone"), 0U);
}

TEST(ProjectName, IsOfLettersDigitsAndAFewSigns) {
    std::string longer_than_200_bytes;
    for (int i = 0; i < 67; ++i) longer_than_200_bytes += "\xe9\xa0\xad";
    for (const std::string& name : {std::string(),
                                    std::string(" a"),
                                    std::string(".a"),
                                    std::string("-rf"),
                                    std::string("a/b"),
                                    std::string(".."),
                                    std::string("a\nb"),
                                    std::string("a\0b", 3),
                                    std::string(81, 'a'),
                                    std::string("\xc3"),
                                    std::string("a\xff"),
                                    std::string("a\xc2\xa0"
                                                "b"),
                                    std::string("a\xe2\x80\xae"
                                                "b"),
                                    std::string("a\xc2\xad"
                                                "b"),
                                    std::string("a\xe2\x80\x8b"
                                                "b"),
                                    std::string("\xed\xa0\x80"),
                                    std::string("\xe3\x85\xa4"),
                                    std::string("\xef\xbc\x8f"),
                                    longer_than_200_bytes,
                                    std::string("<b>"),
                                    std::string("a'b"),
                                    std::string("a\"b"),
                                    std::string("a:b"),
                                    std::string("_a")}) {
        EXPECT_FALSE(is_project_name(name)) << name;
    }
    for (const std::string& name :
         {std::string("a"), std::string("Skull 2.5 of_B-7"), std::string(80, 'a'),
          std::string("Sch\xc3\xa4"
                      "del 3"),
          std::string("\xc3\xa4"), std::string("\xd1\x87\xd0\xb5\xd1\x80\xd0\xb5\xd0\xbf"),
          std::string("\xe9\xa0\xad\xe9\xaa\xa8 1"), std::string("a\xcc\x88"), std::string("\xc2\xb2")}) {
        EXPECT_TRUE(is_project_name(name)) << name;
    }
}

}  // namespace
}  // namespace qchopper
