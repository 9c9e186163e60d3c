// Six parts, one after the other, until one cannot go on. O(reads), which the clock bounds.

#include "devices/link_check/link_check.h"

#include <algorithm>

#include "devices/link_check/link_checker.h"

namespace qchopper {

bool LinkCheck::holds() const {
    return std::ranges::all_of(rules, [](const CheckedRule& rule) { return rule.holds; });
}

LinkCheck check_link(RegisterBus& bus, const LinkCheckOptions& options, const Context& context) {
    link_check::LinkChecker checker(bus, options, context);
    try {
        check_reads(checker);
        check_frames(checker);
        check_lease(checker);
        check_queries(checker);
        check_job(checker);
        check_release(checker);
    } catch (const link_check::CheckEnds&) {
        checker.leave_out("What follows in the check was left out, because the cell did not go on as the map demands.");
    }
    return checker.take();
}

}  // namespace qchopper
