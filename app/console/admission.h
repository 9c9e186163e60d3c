// Which requests are answered at all, decided by their head.
//
// A pure function of request and rules. The order of its questions is that of the table in admission.cpp, from what
// says least about this program to what says most; a body is read after all of them. Against requests that a page of
// another origin makes: Host and Origin are compared with the names of this server (DNS rebinding), and no cookie is
// ever used. Fetch Metadata Request Headers, W3C, 2021.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/console/http/http_message.h"
#include "app/console/routes.h"

namespace qchopper {

struct ConsoleRules {
    std::string key;                 // of Authorization: Bearer
    std::vector<std::string> hosts;  // "127.0.0.1:8720", as Host may say
    bool is_read_only = false;       // only what changes nothing is answered
};

struct RequestRefusal {
    unsigned status = 0;
    std::string why;         // a sentence without its full stop
    bool is_of_key = false;  // a wrong key, or none
};

// Nothing: the request is admitted. `match` is that of its method and path.
std::optional<RequestRefusal> refusal_of(const HttpRequest& head, const RouteMatch& match, const ConsoleRules& rules);

// The revision of If-Match, without quotes; empty if there is none.
std::string revision_of(const HttpRequest& request);

// Compares all bytes in any case, so that the time says nothing of a key.
bool is_same_secret(const std::string& a, const std::string& b);

}  // namespace qchopper
