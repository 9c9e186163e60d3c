// The aggregates of KRL: {X 1.00,Y 2.00,...}, read by their components' names in any order.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "sim/program/krl_line.h"
#include "sim/program/parsed_program.h"

namespace qchopper {

// Components in the order of this table; a bit of `given` for each that was stated.
enum class KrlComponent : std::uint8_t { x, y, z, a, b, c, a1, a2, a3, a4, a5, a6, e1 };

struct KrlAggregate {
    std::array<double, 13> value{};  // mm and degrees, as written
    std::uint32_t given = 0;
    bool has(KrlComponent component) const { return (given >> static_cast<unsigned>(component) & 1U) != 0; }
    double operator[](KrlComponent component) const { return value[static_cast<std::size_t>(component)]; }
};

constexpr std::uint32_t krl_position = 0b111;       // X, Y, Z
constexpr std::uint32_t krl_frame = 0b111111;       // and A, B, C
constexpr std::uint32_t krl_axes = 0b111111 << 6U;  // A1..A6
constexpr std::uint32_t krl_external = 1U << 12U;   // E1

// From "{" to "}". A component that is unknown, doubled or out of range is refused: 5 m, 180 degrees of A, B, C, 720
// degrees of an axis.
KrlAggregate read_aggregate(KrlLine& line);

// The frame of an aggregate with all of krl_frame and nothing else; others are refused.
ProgramFrame read_frame(KrlLine& line);

// {M m,CM {X x,Y y,Z z,A a,B b,C c},J {X x,Y y,Z z}}
ProgramLoad read_load(KrlLine& line);

}  // namespace qchopper
