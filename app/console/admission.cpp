// A table of questions, of which the first that is answered refuses the request.

#include "app/console/admission.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace qchopper {
namespace {

constexpr std::size_t shortest_id = 8;
constexpr std::size_t longest_id = 64;

bool is_known_host(const HttpRequest& head, const ConsoleRules& rules) {
    const std::optional<std::string_view> host = head.value("Host");
    return host && std::ranges::find(rules.hosts, *host) != rules.hosts.end();
}

bool is_own_origin(const HttpRequest& head, const ConsoleRules& rules) {
    const auto is_own = [&](std::string_view origin) {
        return std::ranges::any_of(rules.hosts, [&](const std::string& host) { return origin == "http://" + host; });
    };
    const auto is_own_site = [](std::string_view site) { return site == "same-origin" || site == "none"; };
    return std::ranges::all_of(head.values("Origin"), is_own) &&
           std::ranges::all_of(head.values("Sec-Fetch-Site"), is_own_site);
}

bool has_key(const HttpRequest& head, const ConsoleRules& rules) {
    const std::optional<std::string_view> given = head.value("Authorization");
    return given && is_same_secret(std::string(*given), "Bearer " + rules.key);
}

// Whether another program passes the request on, for somebody who may be elsewhere.
bool is_passed_on(const HttpRequest& head) {
    constexpr std::array names{"Forwarded",        "X-Forwarded",       "X-Forwarded-For",    "X-Forwarded-Host",
                               "X-Forwarded-Port", "X-Forwarded-Proto", "X-Forwarded-Server", "X-Real-IP",
                               "X-Client-IP",      "True-Client-IP",    "CF-Connecting-IP",   "Via"};
    return std::ranges::any_of(names, [&](const char* name) { return !head.values(name).empty(); });
}

bool has_request_id(const HttpRequest& head) {
    const std::optional<std::string_view> id = head.value("X-Request-Id");
    const auto is_allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-'; };
    return id && id->size() >= shortest_id && id->size() <= longest_id && std::ranges::all_of(*id, is_allowed);
}

bool is_json(const HttpRequest& head) {
    const std::optional<std::string_view> type = head.value("Content-Type");
    return type && type->substr(0, type->find(';')) == "application/json";
}

bool changes(const RouteRow& row) {
    return row.method != "GET" && row.route != Route::ask;
}

// A ticket is for what may be shown.
bool is_for_showing(const RouteRow& row) {
    return !changes(row) || row.route == Route::make_ticket;
}

}  // namespace

bool is_same_secret(const std::string& a, const std::string& b) {
    unsigned difference = a.size() == b.size() ? 0 : 1;
    for (std::size_t i = 0; i < b.size(); ++i) {
        difference |= static_cast<unsigned char>(b[i]) ^ static_cast<unsigned char>(i < a.size() ? a[i] : 0);
    }
    return difference == 0;
}

std::string revision_of(const HttpRequest& request) {
    std::string_view value = request.value("If-Match").value_or("");
    if (value.size() >= 2 && value.front() == '"' && value.back() == '"') value = value.substr(1, value.size() - 2);
    return std::string(value);
}

std::optional<RequestRefusal> refusal_of(const HttpRequest& head, const RouteMatch& match, const ConsoleRules& rules) {
    if (head.version != 11) return RequestRefusal{403, "only HTTP/1.1 is answered"};
    if (!is_known_host(head, rules)) return RequestRefusal{403, "this server has another name than Host says"};
    if (!is_own_origin(head, rules)) return RequestRefusal{403, "the request comes from a page of another server"};
    if (head.target.find('%') != std::string::npos) return RequestRefusal{400, "the address holds a percent sign"};
    const bool is_open = match.row != nullptr && match.row->access == RouteAccess::open;
    if (!is_open && !has_key(head, rules)) {
        return RequestRefusal{401, "the key is missing or wrong: open the link that qchopper serve has printed", true};
    }
    if (match.row == nullptr) {
        if (match.is_other_method) return RequestRefusal{405, "nothing is answered to this method here"};
        return RequestRefusal{404, "there is nothing at this address"};
    }
    const RouteRow& row = *match.row;
    if (row.access == RouteAccess::moves && (!head.is_from_this_machine || is_passed_on(head))) {
        return RequestRefusal{403, "what may move a cell is taken from a browser on this machine only"};
    }
    if (rules.is_read_only && !is_for_showing(row)) return RequestRefusal{403, "this server only shows"};
    if (row.method == "POST" && !is_json(head)) return RequestRefusal{400, "the body is not application/json"};
    if (changes(row) && !has_request_id(head)) return RequestRefusal{400, "X-Request-Id is missing or wrong"};
    if (row.needs_revision && revision_of(head).empty())
        return RequestRefusal{428, "If-Match with a revision is missing"};
    return {};
}

}  // namespace qchopper
