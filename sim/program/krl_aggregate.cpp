// Name, number, comma, until the brace closes.

#include "sim/program/krl_parts.h"

#include <string>

namespace qchopper {
namespace {

constexpr std::array<std::string_view, 13> names{"x", "y", "z", "a", "b", "c", "a1", "a2", "a3", "a4", "a5", "a6", "e"};

double largest_of(std::size_t component) {
    if (component < 3) return 5000;  // mm
    if (component < 6) return 180;   // degrees
    return component < 12 ? 720 : 3600;
}

Vec3 position_of(const KrlAggregate& a) {
    return {a[KrlComponent::x], a[KrlComponent::y], a[KrlComponent::z]};
}

}  // namespace

KrlAggregate read_aggregate(ProgramLine& line) {
    KrlAggregate read;
    line.need('{');
    do {
        std::string name = line.word();
        if (name.size() == 2 && name[0] == 'e' && name[1] >= '1' && name[1] <= '6') {
            read.external_axis = static_cast<std::uint32_t>(name[1] - '0');
            name = "e";
        } else if (name == "e") {
            name.clear();
        }
        std::size_t component = 0;
        while (component < names.size() && names[component] != name) ++component;
        if (component == names.size()) line.refuse("\"" + name + "\" is no component");
        const std::uint32_t bit = 1U << component;
        if ((read.given & bit) != 0) line.refuse("\"" + name + "\" stands twice");
        read.given |= bit;
        read.value[component] = line.number(-largest_of(component), largest_of(component));
    } while (line.takes(','));
    line.need('}');
    return read;
}

ProgramFrame read_frame(ProgramLine& line) {
    const KrlAggregate a = read_aggregate(line);
    if (a.given != krl_frame) line.refuse("X, Y, Z, A, B and C are needed, and nothing else");
    return {position_of(a), degree * Vec3{a[KrlComponent::a], a[KrlComponent::b], a[KrlComponent::c]}};
}

ProgramLoad read_load(ProgramLine& line) {
    ProgramLoad load;
    line.need('{');
    line.need_word("m");
    load.mass_kg = line.number(0, 1000);
    line.need(',');
    line.need_word("cm");
    load.centre = read_frame(line);
    line.need(',');
    line.need_word("j");
    const KrlAggregate inertia = read_aggregate(line);
    if (inertia.given != krl_position) line.refuse("J needs X, Y and Z, and nothing else");
    load.inertia = position_of(inertia);
    line.need('}');
    return load;
}

}  // namespace qchopper
