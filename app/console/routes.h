// The requests that the console answers, as one table; docs/developer/console.md prints it.

#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace qchopper {

enum class Route {
    hello,
    state,
    files,
    choices,
    begin_check,
    check,
    begin_repair,
    make_project,
    project,
    decide,
    ask,
    begin_work,
    stop_work,
    mesh,
    surface_states,
    tool_way,
    job_file,
    output,
    make_ticket,
    use_ticket,
    plan,
    hand_over,
    change_queue,
    command_cell,
    change_simulator,
    journal,
    events,
    page
};

// Who may send a request beside the holder of the key.
enum class RouteAccess {
    open,  // needs no key
    key,
    moves  // may set a cell in motion: of this machine only, and never passed on by another program
};

struct RouteRow {
    Route route;
    std::string_view method;
    std::string_view path;  // a part that is * stands for an id: 1 to 64 letters, digits, '.', '_' and '-'
    RouteAccess access = RouteAccess::key;
    bool needs_revision = false;  // of the project, in If-Match
    std::size_t body_bytes = 0;   // at most
    std::string_view about;
};

std::span<const RouteRow> route_rows();

struct RouteMatch {
    const RouteRow* row = nullptr;      // nullptr: nothing answers at this path
    std::vector<std::string> ids = {};  // of the parts that are *
    bool is_other_method = false;       // something does, by another method
};

// `path`: without the query.
RouteMatch match_route(std::string_view method, std::string_view path);

}  // namespace qchopper
