// Fields are looked for one after the other: O(fields).

#include "app/console/http/http_message.h"

#include <algorithm>
#include <cctype>

namespace qchopper {
namespace {

bool is_same_name(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    return std::ranges::equal(a, b, {}, lower, lower);
}

}  // namespace

std::vector<std::string_view> HttpRequest::values(std::string_view name) const {
    std::vector<std::string_view> found;
    for (const auto& [field, value] : fields) {
        if (is_same_name(field, name)) found.emplace_back(value);
    }
    return found;
}

std::optional<std::string_view> HttpRequest::value(std::string_view name) const {
    const std::vector<std::string_view> found = values(name);
    return found.size() == 1 ? std::optional(found.front()) : std::nullopt;
}

std::string_view HttpRequest::path() const {
    return std::string_view(target).substr(0, target.find('?'));
}

std::string_view HttpRequest::query() const {
    const std::size_t mark = target.find('?');
    return mark == std::string::npos ? std::string_view() : std::string_view(target).substr(mark + 1);
}

HttpAnswer json_answer(unsigned status, std::string document) {
    return {status, {{"Content-Type", "application/json; charset=utf-8"}}, std::move(document)};
}

}  // namespace qchopper
