// The plan file: a plan that is read, written and read again is the same plan. Writing replaces control characters in
// its texts, so it is written twice.

#include "app/store/plan.h"
#include "tests/fuzz/demand.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace qchopper;
    const std::string text = text_of(data, size);
    or_refused(InputFault::config, [&] {
        const Plan read = plan_from_text(text, "fuzz.toml");
        for (std::size_t i = 0; i < read.cuts.size(); ++i) demand(read.cuts[i].number == static_cast<int>(i) + 1);
        Plan plan;
        try {
            plan = plan_from_text(to_text(read), "written.toml");
        } catch (const InputError&) {
            std::abort();
        }
        demand(plan.cuts.size() == read.cuts.size());
        for (std::size_t i = 0; i < read.cuts.size(); ++i) demand(plan.cuts[i].plane == read.cuts[i].plane);
        demand(plan_from_text(to_text(plan), "again.toml") == plan);
    });
    return 0;
}
