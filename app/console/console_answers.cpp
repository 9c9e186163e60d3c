#include "app/console/console_answers.h"

#include <algorithm>

namespace qchopper {
namespace {

constexpr const char* content_policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src 'self'; "
    "worker-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

}  // namespace

void add_guards(HttpAnswer& answer) {
    const auto add = [&](const char* name, const char* value) {
        const auto is_same = [&](const auto& field) { return field.first == name; };
        if (std::ranges::none_of(answer.fields, is_same)) answer.fields.emplace_back(name, value);
    };
    add("X-Content-Type-Options", "nosniff");
    add("Referrer-Policy", "no-referrer");
    add("Cross-Origin-Opener-Policy", "same-origin");
    add("Cross-Origin-Resource-Policy", "same-origin");
    add("Content-Security-Policy", content_policy);
    add("Cache-Control", "no-store");
}

HttpAnswer http_answer(const WorkerAnswer& answer) {
    return json_answer(answer.status, answer.document);
}

HttpAnswer refusal(unsigned status, const std::string& what, const Sentence& to_do) {
    return http_answer(error_answer(status, what, "Nothing was changed.", to_do));
}

}  // namespace qchopper
