#include "app/console/admission.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace qchopper {
namespace {

const ConsoleRules rules{"0123456789abcdef0123456789abcdef", {"127.0.0.1:8720", "localhost:8720"}, false};

// Of nothing to refuse: a request as the page sends it.
HttpRequest good(const std::string& method, const std::string& target) {
    HttpRequest head{method, target, 11, {}, {}, true};
    head.fields = {{"Host", "127.0.0.1:8720"}, {"Authorization", "Bearer " + rules.key}};
    if (method == "POST") head.fields.emplace_back("Content-Type", "application/json");
    if (method != "GET") {
        head.fields.emplace_back("X-Request-Id", "0a1b2c3d-4e5f");
        head.fields.emplace_back("If-Match", "\"0123456789abcdef\"");
    }
    return head;
}

const HttpRequest decide = good("POST", "/api/projects/1/decisions");
const HttpRequest commands = good("POST", "/api/cells/1/commands");

HttpRequest with(HttpRequest head, const std::string& name, const std::string& value) {
    head.fields.emplace_back(name, value);
    return head;
}

HttpRequest without(HttpRequest head, const std::string& name) {
    std::erase_if(head.fields, [&](const auto& field) { return field.first == name; });
    return head;
}

HttpRequest changed(const HttpRequest& head, const std::string& name, const std::string& value) {
    return with(without(head, name), name, value);
}

// 0: it is admitted.
unsigned status_of(const HttpRequest& head, const ConsoleRules& of = rules) {
    const auto refused = refusal_of(head, match_route(head.method, head.path()), of);
    if (refused) {
        EXPECT_FALSE(refused->why.empty());
    }
    return refused ? refused->status : 0;
}

TEST(Admission, EveryRouteIsAnsweredToThePage) {
    for (const RouteRow& row : route_rows()) {
        std::string path(row.path);
        std::ranges::replace(path, '*', 'a');
        EXPECT_EQ(status_of(good(std::string(row.method), path)), 0U) << row.method << " " << path;
        EXPECT_EQ(status_of(changed(good(std::string(row.method), path), "Host", "localhost:8720")), 0U) << path;
    }
}

TEST(Admission, WithoutAKeyThePagesFilesHelloAndTicketsAreAllThatIsAnswered) {
    std::vector<std::string> open;
    for (const RouteRow& row : route_rows()) {
        std::string path(row.path);
        std::ranges::replace(path, '*', 'a');
        const HttpRequest head = without(good(std::string(row.method), path), "Authorization");
        if (status_of(head) == 0) open.push_back(path);
        if (status_of(head) != 0) {
            EXPECT_EQ(status_of(head), 401U) << path;
        }
    }
    EXPECT_EQ(open, (std::vector<std::string>{"/api/hello", "/api/t/a", "/", "/a"}));
}

TEST(Admission, AHostThatIsReboundIsRefused) {
    for (const char* host : {"evil.example:8720", "127.0.0.1:8720.evil.example", "127.0.0.1", "127.0.0.1:8721", "",
                             "localhost", "[::1]:8720", "127.0.0.1:8720 ", "127.0.0.1:8720@evil.example"}) {
        EXPECT_EQ(status_of(changed(decide, "Host", host)), 403U) << host;
        EXPECT_EQ(status_of(changed(good("GET", "/api/hello"), "Host", host)), 403U) << host;
        EXPECT_EQ(status_of(changed(good("GET", "/"), "Host", host)), 403U) << host;
    }
}

TEST(Admission, HostStandsExactlyOnce) {
    EXPECT_EQ(status_of(without(decide, "Host")), 403U);
    EXPECT_EQ(status_of(with(decide, "Host", "127.0.0.1:8720")), 403U);
    EXPECT_EQ(status_of(with(decide, "host", "evil.example")), 403U);
    EXPECT_EQ(status_of(with(without(decide, "Host"), "hOST", "127.0.0.1:8720")), 0U);
}

TEST(Admission, OnlyHttpOneDotOneIsAnswered) {
    for (const int version : {9, 10, 12, 20}) {
        HttpRequest head = decide;
        head.version = version;
        EXPECT_EQ(status_of(head), 403U) << version;
    }
}

TEST(Admission, APageOfAnotherOriginIsRefused) {
    for (const char* origin :
         {"http://evil.example", "null", "https://127.0.0.1:8720", "http://127.0.0.1:8721", "http://127.0.0.1",
          "http://127.0.0.1:8720.evil.example", "http://127.0.0.1:8720/", "", "file://"}) {
        EXPECT_EQ(status_of(with(decide, "Origin", origin)), 403U) << origin;
    }
    EXPECT_EQ(status_of(with(decide, "Origin", "http://127.0.0.1:8720")), 0U);
    EXPECT_EQ(status_of(with(decide, "origin", "http://localhost:8720")), 0U);
    EXPECT_EQ(status_of(with(with(decide, "Origin", "http://127.0.0.1:8720"), "Origin", "http://evil.example")), 403U);
}

TEST(Admission, ARequestThatAnotherSiteBeganIsRefused) {
    for (const char* site : {"cross-site", "same-site", "", "SAME-ORIGIN"}) {
        EXPECT_EQ(status_of(with(decide, "Sec-Fetch-Site", site)), 403U) << site;
        EXPECT_EQ(status_of(with(good("GET", "/"), "sec-fetch-site", site)), 403U) << site;
    }
    EXPECT_EQ(status_of(with(decide, "Sec-Fetch-Site", "same-origin")), 0U);
    EXPECT_EQ(status_of(with(good("GET", "/"), "Sec-Fetch-Site", "none")), 0U);
}

TEST(Admission, WhatMayMoveIsTakenFromThisMachineOnly) {
    for (const RouteRow& row : route_rows()) {
        std::string path(row.path);
        std::ranges::replace(path, '*', 'a');
        HttpRequest far = good(std::string(row.method), path);
        far.is_from_this_machine = false;
        EXPECT_EQ(status_of(far), row.access == RouteAccess::moves ? 403U : 0U) << path;
    }
}

TEST(Admission, WhatMayMoveIsNotPassedOn) {
    for (const char* name : {"Forwarded", "X-Forwarded-For", "x-forwarded-host", "X-Real-IP", "VIA",
                             "X-Forwarded-Proto", "X-Forwarded-Server", "X-Forwarded-Port", "X-Forwarded",
                             "CF-Connecting-IP", "True-Client-IP", "X-Client-IP"}) {
        EXPECT_EQ(status_of(with(commands, name, "10.0.0.1")), 403U) << name;
        EXPECT_EQ(status_of(with(commands, name, "")), 403U) << name;
        EXPECT_EQ(status_of(with(decide, name, "10.0.0.1")), 0U) << name;
    }
}

TEST(Admission, APercentSignIsRefusedEverywhere) {
    for (const char* target : {"/%61pi/state", "/api/meshes/%2e%2e", "/api/state?after=%41", "/%", "/api/hello%00"}) {
        EXPECT_EQ(status_of(good("GET", target)), 400U) << target;
    }
}

TEST(Admission, AWrongKeyIsNoKey) {
    for (const std::string& value :
         {rules.key, "bearer " + rules.key, "Bearer  " + rules.key, "Bearer " + rules.key + " ", std::string("Bearer"),
          std::string("Bearer "), "Basic " + rules.key, "Bearer " + rules.key.substr(1), "Bearer " + rules.key + "0",
          std::string(), "Bearer " + std::string(32, '0')}) {
        EXPECT_EQ(status_of(changed(decide, "Authorization", value)), 401U) << value;
    }
    EXPECT_EQ(status_of(without(decide, "Authorization")), 401U);
    EXPECT_EQ(status_of(with(decide, "Authorization", "Bearer " + rules.key)), 401U) << "two keys are none";
    const auto refused = refusal_of(without(decide, "Authorization"), match_route("POST", decide.path()), rules);
    EXPECT_TRUE(refused->is_of_key);
    EXPECT_EQ(refused->why.find(rules.key), std::string::npos);
}

TEST(Admission, WithoutAKeyNothingIsSaidOfWhatIsThere) {
    for (const char* target : {"/api/state", "/api/no/such/thing", "/api/projects/1/decisions", "/a/b/c"}) {
        EXPECT_EQ(status_of(without(good("GET", target), "Authorization")), 401U) << target;
    }
    EXPECT_EQ(status_of(good("GET", "/api/no/such/thing")), 404U);
    EXPECT_EQ(status_of(good("GET", "/api/projects/1/decisions")), 405U);
    EXPECT_EQ(status_of(good("PUT", "/api/projects/1/decisions")), 405U);
}

TEST(Admission, ABodyIsJson) {
    for (const char* type : {"text/plain", "application/x-www-form-urlencoded", "multipart/form-data; boundary=x", "",
                             "application/jsonx", "text/json"}) {
        EXPECT_EQ(status_of(changed(decide, "Content-Type", type)), 400U) << type;
    }
    EXPECT_EQ(status_of(without(decide, "Content-Type")), 400U);
    EXPECT_EQ(status_of(changed(decide, "Content-Type", "application/json; charset=utf-8")), 0U);
}

TEST(Admission, WhatChangesSomethingHasARequestId) {
    for (const std::string& id : {std::string("1234567"), std::string(65, 'a'), std::string("12345678\n"),
                                  std::string("1234 5678"), std::string("12345678_"), std::string()}) {
        EXPECT_EQ(status_of(changed(decide, "X-Request-Id", id)), 400U) << id;
    }
    EXPECT_EQ(status_of(without(decide, "X-Request-Id")), 400U);
    EXPECT_EQ(status_of(with(decide, "X-Request-Id", "0a1b2c3d-4e5f")), 400U) << "two ids are none";
    EXPECT_EQ(status_of(changed(decide, "X-Request-Id", std::string(64, 'z'))), 0U);
    EXPECT_EQ(status_of(without(good("POST", "/api/projects/1/questions"), "X-Request-Id")), 0U);
    EXPECT_EQ(status_of(without(good("DELETE", "/api/work/W1"), "X-Request-Id")), 400U);
}

TEST(Admission, ADecisionNamesItsRevision) {
    EXPECT_EQ(status_of(without(decide, "If-Match")), 428U);
    EXPECT_EQ(status_of(changed(decide, "If-Match", "")), 428U);
    EXPECT_EQ(status_of(changed(decide, "If-Match", "\"\"")), 428U);
    EXPECT_EQ(status_of(with(decide, "If-Match", "\"0123456789abcdef\"")), 428U) << "two revisions are none";
    EXPECT_EQ(revision_of(decide), "0123456789abcdef");
    EXPECT_EQ(revision_of(changed(decide, "If-Match", "0123")), "0123");
    EXPECT_EQ(revision_of(changed(decide, "If-Match", "\"")), "\"");
    EXPECT_EQ(revision_of(without(decide, "If-Match")), "");
}

TEST(Admission, AServerThatOnlyShowsAnswersWhatChangesNothing) {
    ConsoleRules shows = rules;
    shows.is_read_only = true;
    std::vector<std::string> answered;
    for (const RouteRow& row : route_rows()) {
        std::string path(row.path);
        std::ranges::replace(path, '*', 'a');
        const unsigned status = status_of(good(std::string(row.method), path), shows);
        if (row.method != "GET" && status == 0) answered.push_back(path);
        if (row.method != "GET" && status != 0) {
            EXPECT_EQ(status, 403U);
        }
        if (row.method == "GET") {
            EXPECT_EQ(status, 0U) << path;
        }
    }
    EXPECT_EQ(answered, (std::vector<std::string>{"/api/projects/a/questions", "/api/tickets"}));
}

TEST(Admission, SecretsAreComparedToTheLastByte) {
    EXPECT_TRUE(is_same_secret("", ""));
    EXPECT_TRUE(is_same_secret("abc", "abc"));
    for (const char* other : {"", "a", "ab", "abd", "bbc", "abcd", "abca"}) {
        EXPECT_FALSE(is_same_secret(other, "abc")) << other;
        EXPECT_FALSE(is_same_secret("abc", other)) << other;
    }
    EXPECT_FALSE(is_same_secret(std::string("abc\0", 4), "abc"));
}

}  // namespace
}  // namespace qchopper
