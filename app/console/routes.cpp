// Rows are compared part by part, in their order: O(rows).

#include "app/console/routes.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace qchopper {
namespace {

constexpr std::size_t small_body = 64 * 1024;
constexpr std::size_t strokes_body = 1024 * 1024;
constexpr std::size_t id_length = 64;

using enum Route;
constexpr RouteAccess any = RouteAccess::open;
constexpr RouteAccess key = RouteAccess::key;
constexpr RouteAccess moves = RouteAccess::moves;

constexpr std::array rows{
    RouteRow{hello, "GET", "/api/hello", any, false, 0, "server, version, hash of the page"},
    RouteRow{state, "GET", "/api/state", key, false, 0, "projects, work, cells, queue, newest event"},
    RouteRow{files, "GET", "/api/files", key, false, 0, "scans and projects of the folder"},
    RouteRow{choices, "GET", "/api/choices", key, false, 0, "units, presets and cell files"},
    RouteRow{begin_check, "POST", "/api/checks", key, false, small_body, "looks at a scan"},
    RouteRow{check, "GET", "/api/checks/*", key, false, 0, "what was found"},
    RouteRow{begin_repair, "POST", "/api/checks/*/repair", key, false, small_body, "repairs a copy of the scan"},
    RouteRow{make_project, "POST", "/api/projects", key, false, strokes_body, "makes a project of a scan"},
    RouteRow{project, "GET", "/api/projects/*", key, false, 0, "a project as it stands"},
    RouteRow{decide, "POST", "/api/projects/*/decisions", key, true, small_body, "takes a decision"},
    RouteRow{ask, "POST", "/api/projects/*/questions", key, false, small_body, "answers a question, decides nothing"},
    RouteRow{begin_work, "POST", "/api/projects/*/work", key, true, small_body, "runs a command"},
    RouteRow{job_file, "GET", "/api/projects/*/jobs/*/files/*", key, false, 0, "a file of a job"},
    RouteRow{output, "GET", "/api/projects/*/outputs/*", key, false, 0, "the assembly guide"},
    RouteRow{stop_work, "DELETE", "/api/work/*", key, false, 0, "stops a work, which keeps what is saved"},
    RouteRow{mesh, "GET", "/api/meshes/*", key, false, 0, "a display mesh"},
    RouteRow{surface_states, "GET", "/api/meshes/*/states/*", key, false, 0, "a state for each of its faces"},
    RouteRow{tool_way, "GET", "/api/paths/*", key, false, 0, "the way of the tool in a replay"},
    RouteRow{make_ticket, "POST", "/api/tickets", key, false, small_body, "an address for a new tab"},
    RouteRow{use_ticket, "GET", "/api/t/*", any, false, 0, "what the ticket was made for, once"},
    RouteRow{plan, "POST", "/api/projects/*/plans", moves, true, small_body, "jobs to be handed over, checked"},
    RouteRow{hand_over, "POST", "/api/dispatches", moves, false, small_body, "hands the jobs of a plan to the cell"},
    RouteRow{change_queue, "POST", "/api/queue", moves, false, small_body, "pauses, goes on, removes"},
    RouteRow{command_cell, "POST", "/api/cells/*/commands", moves, false, small_body, "Hold and the other commands"},
    RouteRow{change_simulator, "POST", "/api/simulator", moves, false, small_body, "a line for the simulated cell"},
    RouteRow{journal, "GET", "/api/journal", key, false, 0, "what cells have carved, and when"},
    RouteRow{events, "GET", "/api/events", key, false, 0, "what changes, as it does"},
    RouteRow{page, "GET", "/", any, false, 0, "the page"},
    RouteRow{page, "GET", "/*", any, false, 0, "a file of the page"},
};

bool is_id(std::string_view part) {
    const auto is_allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-'; };
    return !part.empty() && part.size() <= id_length && std::ranges::all_of(part, is_allowed) && part != "." &&
           part != "..";
}

// The part before the next slash; the rest stays in `path`. Precondition: it begins with a slash.
std::string_view take_part(std::string_view& path) {
    path.remove_prefix(1);
    const std::string_view part = path.substr(0, path.find('/'));
    path.remove_prefix(part.size());
    return part;
}

std::optional<std::vector<std::string>> ids_of(std::string_view pattern, std::string_view path) {
    std::vector<std::string> ids;
    while (pattern.starts_with('/') && path.starts_with('/')) {
        const std::string_view wanted = take_part(pattern);
        const std::string_view part = take_part(path);
        if (wanted == "*" ? !is_id(part) : wanted != part) return {};
        if (wanted == "*") ids.emplace_back(part);
    }
    if (!pattern.empty() || !path.empty()) return {};
    return ids;
}

}  // namespace

std::span<const RouteRow> route_rows() {
    return rows;
}

RouteMatch match_route(std::string_view method, std::string_view path) {
    RouteMatch match;
    for (const RouteRow& row : rows) {
        std::optional<std::vector<std::string>> ids = ids_of(row.path, path);
        if (!ids) continue;
        if (row.method == method) return {&row, std::move(*ids), false};
        match.is_other_method = true;
    }
    return match;
}

}  // namespace qchopper
