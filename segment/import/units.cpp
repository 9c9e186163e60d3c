// The table of units.

#include <array>

#include "base/error.h"
#include "base/text.h"
#include "segment/import/import_scan.h"

namespace qchopper {
namespace {

struct UnitName {
    std::string_view name;
    double mm;
};
constexpr std::array<UnitName, 6> units{
    {{"mm", 1}, {"cm", 10}, {"m", 1000}, {"in", 25.4}, {"ft", 304.8}, {"um", 0.001}}};  // in the order of Unit

std::string describe_unit(double mm) {
    for (const UnitName& unit : units) {
        if (unit.mm == mm) return std::string(unit.name);
    }
    return significant(mm, 6) + " mm";
}

}  // namespace

double mm_per(Unit unit) {
    return units[static_cast<std::size_t>(unit)].mm;
}

std::string name_of(Unit unit) {
    return std::string(units[static_cast<std::size_t>(unit)].name);
}

Unit unit_named(std::string_view name) {
    for (std::size_t i = 0; i < units.size(); ++i) {
        if (units[i].name == name) return static_cast<Unit>(i);
    }
    throw InputError(InputFault::use, "unknown unit \"" + std::string(name) + "\"", "use mm, cm, m or in");
}

Unit unit_of(double mm) {
    for (std::size_t i = 0; i < units.size(); ++i) {
        if (units[i].mm == mm) return static_cast<Unit>(i);
    }
    throw InputError(InputFault::use, "a unit of " + significant(mm, 6) + " mm has no name",
                     Sentence::with_key("give_unit", {}, "give the unit of the scan: mm, cm, m or in"));
}

std::optional<double> agreed_mm_per_unit(std::optional<double> in_file, std::optional<double> given,
                                         const std::string& name) {
    if (in_file && given && *in_file != *given) {
        throw InputError(
            InputFault::use,
            name + " has the unit " + describe_unit(*in_file) + ", but it is to be read in " + describe_unit(*given),
            Sentence::with_key(
                "leave_unit", {},
                "leave the unit to the file; if it is wrong, save it in a format without units, such as PLY"));
    }
    return in_file ? in_file : given;
}

}  // namespace qchopper
