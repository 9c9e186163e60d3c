// Text and JSON from the values of one check.

#include "app/report/workholding_report.h"

#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cam/job/setup_fields.h"

namespace qchopper {

std::string workholding_word(const Setup& setup) {
    return !setup.workholding ? "-" : setup.workholding->passes() ? "yes" : "no";
}

nlohmann::ordered_json workholding_json(const Setup& setup) {
    if (!setup.workholding) return nullptr;
    nlohmann::ordered_json json;
    json_values::JsonWriter writer(json);
    fields(writer, *setup.workholding);
    writer("problem", workholding_problem(*setup.workholding));
    writer("remedy", workholding_remedy(*setup.workholding));
    return json;
}

std::vector<std::string> lines(const Workholding& check) {
    std::vector<std::string> text{"Workholding: tape or glue up to " + fixed(check.joint_force, 1) +
                                  " N at its top, foam up to " + fixed(check.foam_force, 1) + " N (" +
                                  fixed(check.narrowest_mm2 / 100, 1) + " cm2 stand " + fixed(check.narrowest_z, 0) +
                                  " mm above the base), cutting force " + significant(check.holding.cutting_force, 3) +
                                  " N; " + fixed(check.height, 0) + " mm high on a base " + fixed(check.base_width, 0) +
                                  " mm wide."};
    if (!check.passes()) {
        text.push_back("Not held safely: " + workholding_problem(check) + ".");
        text.push_back("To do: " + workholding_remedy(check) + ".");
    }
    return text;
}

}  // namespace qchopper
