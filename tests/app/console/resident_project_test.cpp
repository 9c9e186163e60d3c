#include "app/console/worker/resident_project.h"

#include <gtest/gtest.h>

#include "app/store/project_folder.h"
#include "base/error.h"
#include "base/files/file.h"
#include "tests/app/engine/planned.h"
#include "tests/folder.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

struct Resident : ::testing::Test {
    Folder folder;
    fs::path project = folder.path / "p.qch";
    void SetUp() override { create_project(project, planned::project_of(shapes::stairs(), {}, 0), {}); }

    // As another program does: with a lock and an OpenProject of its own.
    void other_decides(double weight) const {
        const ProjectLock lock(project);
        OpenProject open(project, Context());
        EXPECT_TRUE(open.decide_weights({weight, 1, 1, 1}));
    }
    static double weight_in(ResidentProject& resident) {
        double weight = 0;
        resident.with_project(
            "", [&](OpenProject& open) { weight = open.project().settings.objectives.weights.face_ratio; });
        return weight;
    }
};

TEST_F(Resident, StaysOpenWhileNobodyElseWrites) {
    ResidentProject resident(project, {});
    const OpenProject* first = nullptr;
    resident.with_project("", [&](OpenProject& open) {
        first = &open;
        open.decide_weights({3, 1, 1, 1});
    });
    EXPECT_EQ(resident.revision(), revision_of_project(project));
    resident.with_project(resident.revision(), [&](OpenProject& open) { EXPECT_EQ(&open, first); });
}

TEST_F(Resident, AStaleRevisionIsRefusedBeforeAnythingIsDone) {
    ResidentProject resident(project, {});
    const std::string old = revision_of_project(project);
    other_decides(7);
    const std::string now = revision_of_project(project);
    bool is_called = false;
    try {
        resident.with_project(old, [&](OpenProject&) { is_called = true; });
        ADD_FAILURE() << "it is stale";
    } catch (const StaleRequest& e) {
        EXPECT_NE(std::string(e.what()).find("change of weights"), std::string::npos) << e.what();
    }
    EXPECT_FALSE(is_called);
    EXPECT_EQ(revision_of_project(project), now);
    resident.with_project(now, [&](OpenProject&) { is_called = true; });
    EXPECT_TRUE(is_called);
    for (const char* other : {"0", "*", "0123456789abcdef"}) {
        EXPECT_THROW(resident.with_project(other, [](OpenProject&) {}), StaleRequest);
    }
}

TEST_F(Resident, WhatAnotherProgramDecidesInBetweenIsSeen) {
    ResidentProject resident(project, {});
    for (int i = 2; i < 12; ++i) {
        other_decides(i);
        EXPECT_EQ(weight_in(resident), i);
        EXPECT_EQ(resident.revision(), revision_of_project(project));
    }
}

TEST_F(Resident, AfterAnExceptionItIsReadAgain) {
    ResidentProject resident(project, {});
    EXPECT_THROW(resident.with_project("",
                                       [](OpenProject& open) {
                                           open.decide_weights({9, 1, 1, 1});
                                           throw std::runtime_error("in the middle");
                                       }),
                 std::runtime_error);
    const Project saved = load_project(project);
    resident.with_project(revision_of_project(project), [&](OpenProject& open) { EXPECT_EQ(open.project(), saved); });
}

TEST_F(Resident, IsLockedOnlyWhileItIsUsed) {
    ResidentProject resident(project, {});
    resident.with_project("", [&](OpenProject&) { EXPECT_TRUE(writer_of(project)); });
    EXPECT_FALSE(writer_of(project));
    EXPECT_THROW(resident.with_project("", [](OpenProject&) { throw std::runtime_error(""); }), std::runtime_error);
    EXPECT_FALSE(writer_of(project));
    const ProjectLock lock(project);
    try {
        resident.with_project("", [](OpenProject&) {});
        ADD_FAILURE() << "it is locked";
    } catch (const InputError& e) {
        EXPECT_EQ(e.fault, InputFault::busy);
    }
}

TEST_F(Resident, AProjectThatIsBrokenOrGoneIsSaidAndReadWhenItIsBack) {
    ResidentProject resident(project, {});
    resident.with_project("", [](OpenProject&) {});
    const Bytes good = read_file(project / "project.json", record_limit);
    write_file(project / "project.json", std::string_view("{"));
    EXPECT_THROW(resident.with_project("", [](OpenProject&) {}), InputError);
    fs::remove(project / "project.json");
    EXPECT_THROW(resident.with_project("", [](OpenProject&) {}), InputError);
    write_file(project / "project.json", std::string_view(reinterpret_cast<const char*>(good.data()), good.size()));
    bool is_called = false;
    resident.with_project("", [&](OpenProject&) { is_called = true; });
    EXPECT_TRUE(is_called);
    fs::remove_all(project);
    EXPECT_THROW(resident.with_project("", [](OpenProject&) {}), InputError);
}

}  // namespace
}  // namespace qchopper
