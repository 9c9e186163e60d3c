// A request of HTTP and its answer, as values.
//
// Names of fields are compared without case (RFC 9110, HTTP Semantics, 2022, 5.1). What reads and writes them is
// http_server.h.

#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace qchopper {

using HttpFields = std::vector<std::pair<std::string, std::string>>;

struct HttpRequest {
    std::string method;  // "GET"
    std::string target;  // "/api/state?after=3", at most as long as HttpLimits says
    int version = 11;    // 10 times major plus minor
    HttpFields fields;   // in their order
    std::string body;    // empty until the head is admitted
    bool is_from_this_machine = false;

    // The values of all fields of this name.
    std::vector<std::string_view> values(std::string_view name) const;
    // The only one; nothing if there is none, or several.
    std::optional<std::string_view> value(std::string_view name) const;
    std::string_view path() const;   // of the target, without the query
    std::string_view query() const;  // after the question mark; may be empty
};

struct HttpAnswer {
    unsigned status = 200;
    HttpFields fields = {};
    std::string body = {};
    // Of an event stream: waits at most so long for the next part of the body, which may be empty; nothing ends it.
    std::function<std::optional<std::string>(std::chrono::milliseconds)> next_part = {};
};

// An answer whose body is JSON.
HttpAnswer json_answer(unsigned status, std::string document);

}  // namespace qchopper
