// The process that holds a project for the console: requests come as lines of JSON, and each is answered by one line.
//
// One request at a time. The process ends when its input does. A decision is on the disk before it is answered; killing
// the process at any moment leaves the project before or after it (tests/app/console/worker_test.cpp).

#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "app/store/project_context.h"
#include "base/error.h"

namespace qchopper {

enum class WorkerTask {
    show,    // the project as it stands
    decide,  // read_decision() of the body
    ask,     // read_question() of the body
    plan     // what would be handed over: read_plan() of the body, after the revision
};

struct WorkerRequest {
    WorkerTask task = WorkerTask::show;
    std::string revision;  // for which a decision is made; empty: any
    std::string body;      // JSON
};

struct WorkerAnswer {
    unsigned status = 200;  // of HTTP
    std::string document;   // JSON
};

std::string to_line(const WorkerRequest& request);
std::string to_line(const WorkerAnswer& answer);
// Nothing for any other line.
std::optional<WorkerAnswer> read_answer(const std::string& line);

// The status of HTTP for a fault, and the document qchopper-error-1.
WorkerAnswer error_answer(unsigned status, const std::string& what, const std::string& unchanged,
                          const Sentence& to_do);

WorkerAnswer answer_to(const InputError& error);

// Answers requests until `next_line` returns nothing. Throws Cancelled if a stop was requested.
void work_for_console(const std::filesystem::path& folder, const std::function<std::optional<std::string>()>& next_line,
                      const std::function<void(const std::string&)>& print, const std::string& program_version,
                      const ProjectContext& context);

}  // namespace qchopper
