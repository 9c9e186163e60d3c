// Own words instead of those of the option parser, which print type names and 300-digit bounds.

#include "app/cli/option_checks.h"

#include <algorithm>
#include <charconv>

namespace qchopper {

OptionCheck number_between(double low, double high, const std::string& words) {
    return [=](const std::string& text) {
        double value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool ok = error == std::errc() && end == text.data() + text.size() && value >= low && value <= high;
        return ok ? std::string() : "\"" + text + "\" is not " + words;
    };
}

OptionCheck one_of(const std::vector<std::string>& words) {
    return [=](const std::string& text) {
        if (std::find(words.begin(), words.end(), text) != words.end()) return std::string();
        std::string list;
        for (const std::string& word : words) list += (list.empty() ? "" : ", ") + word;
        return "\"" + text + "\" is not one of " + list;
    };
}

}  // namespace qchopper
