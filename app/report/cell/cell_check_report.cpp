// Text and JSON from a value.

#include "app/report/cell/cell_control_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/report/report_json.h"
#include "base/printable.h"
#include "base/text.h"

namespace qchopper {

template <class V, Of<CheckedRule> T>
void fields(V& v, T& rule) {
    v("block", rule.block);
    v("address", rule.address);
    v("field", rule.field);
    v("rule", rule.rule);
    v("holds", rule.holds);
    v.written("seen", [&] { return printable(rule.seen); });
}

template <class V, Of<LinkCheckReport> T>
void fields(V& v, T& report) {
    v.written("schema", [] { return "qchopper-cell-check-1"; });
    v("endpoint", report.endpoint);
    v.written("deviations", [&] {
        return std::ranges::count_if(report.check.rules, [](const CheckedRule& rule) { return !rule.holds; });
    });
    v("rules", report.check.rules);
    v("not_checked", report.check.not_checked);
}

std::vector<std::string> lines(const LinkCheckReport& report) {
    std::vector<std::string> text;
    for (const CheckedRule& rule : report.check.rules) {
        if (rule.holds) continue;
        text.push_back("deviates: " + rule.block + " " + std::to_string(rule.address) + " " + rule.field + " " +
                       rule.rule + "; seen: " + printable(rule.seen));
    }
    const std::size_t deviations = text.size();
    for (const std::string& why : report.check.not_checked) text.push_back("not checked: " + why);
    const std::string checked = counted(report.check.rules.size(), "rule") + " checked at " + report.endpoint;
    text.push_back(deviations == 0 ? checked + "; no deviation was found"
                                   : checked + "; " + counted(deviations, "rule deviates", "rules deviate"));
    return text;
}

Document document(const LinkCheckReport& report) {
    return compose(json_of<LinkCheckReport, nlohmann::ordered_json>(report));
}

}  // namespace qchopper
