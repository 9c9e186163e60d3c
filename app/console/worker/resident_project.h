// A project that stays in memory between requests, while other programs may change it.
//
// Its folder is locked only while a request is done; the project is read again where project.json is not what is held,
// and after an exception but RefusedRequest, because memory and file may then differ
// (tests/app/console/resident_project_test.cpp).

#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include "app/engine/open_project.h"
#include "app/store/project_context.h"

namespace qchopper {

// The first 16 hexadecimal digits of the SHA-256 of project.json. Throws what read_file throws.
std::string revision_of_project(const std::filesystem::path& folder);

// Why a request was refused without a change of the project, in memory or on the disk: it stays as it is held.
struct RefusedRequest : std::runtime_error {
    using std::runtime_error::runtime_error;
};
// The project is not, or not any more, as the request takes it to be.
struct StaleRequest : RefusedRequest {
    using RefusedRequest::RefusedRequest;
};
// What is asked cannot be: the plane parts nothing.
struct ImpossibleRequest : RefusedRequest {
    using RefusedRequest::RefusedRequest;
};

class ResidentProject {
 public:
    // Reads nothing yet. What the context points to outlives this object.
    ResidentProject(std::filesystem::path folder, ProjectContext context);

    // Locks the project, brings it up to date and calls `use`. `revision`: the one that the request was made for;
    // empty: any. Throws StaleRequest, with who changed what, before `use` is called; what ProjectLock and OpenProject
    // throw, and what `use` throws.
    void with_project(const std::string& revision, const std::function<void(OpenProject&)>& use);

    const std::filesystem::path& folder() const { return folder_; }
    // After the last request.
    const std::string& revision() const { return revision_; }

 private:
    std::filesystem::path folder_;
    ProjectContext context_;
    std::unique_ptr<OpenProject> open_;
    std::string revision_;
};

}  // namespace qchopper
