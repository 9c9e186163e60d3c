// How the fields of a block are written from a value and read into one: the rows of the tables in registers.cpp.
//
// A row binds a field to a member; its type and size are held against the member's when the table is compiled.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>

#include "devices/blocks.h"
#include "devices/field.h"
#include "devices/register_writer.h"

namespace qchopper {

// What a field is to the block, besides a value.
enum class Part : std::uint8_t { value, magic, version, snap_begin, snap_end, crc, reserved };

template <class T>
struct Row {
    Field field;
    Part part;
    void (*put)(const T& from, const Field& field, RegisterWriter& to);
    void (*take)(T& to, const Field& field, RegisterReader& from);
};

// The table of the block that carries a T; defined in registers.cpp.
template <class T>
std::span<const Row<T>> rows_of();
template <>
std::span<const Row<Status>> rows_of();
template <>
std::span<const Row<ResultRecord>> rows_of();
template <>
std::span<const Row<Command>> rows_of();
template <>
std::span<const Row<WireTicket>> rows_of();
template <>
std::span<const Row<Chunk>> rows_of();
template <>
std::span<const Row<Heartbeat>> rows_of();

namespace layout {

template <class Member>
constexpr bool is_word = (std::is_enum_v<Member> || std::is_unsigned_v<Member>)&&sizeof(Member) == 2;

template <class Member>
constexpr bool fits(const Field& field) {
    if constexpr (is_word<Member>) return field.type == FieldType::u16 && field.count == 1;
    if constexpr (std::is_same_v<Member, std::uint32_t>) return field.type == FieldType::u32 && field.count == 2;
    if constexpr (std::is_same_v<Member, std::int32_t>) return field.type == FieldType::i32 && field.count == 2;
    if constexpr (std::is_same_v<Member, std::uint64_t>) return field.type == FieldType::u64 && field.count == 4;
    if constexpr (std::is_same_v<Member, std::string>) return field.type == FieldType::text;
    if constexpr (std::is_same_v<Member, Uuid> || std::is_same_v<Member, Sha256>) {
        return field.type == FieldType::bytes && sizeof(Member) == 2U * field.count;
    }
    return false;
}

template <class Member>
void put(const Member& member, const Field& field, RegisterWriter& to) {
    if constexpr (is_word<Member>) {
        to.u16(static_cast<std::uint16_t>(member));
    } else if constexpr (std::is_same_v<Member, std::uint32_t>) {
        to.u32(member);
    } else if constexpr (std::is_same_v<Member, std::int32_t>) {
        to.i32(member);
    } else if constexpr (std::is_same_v<Member, std::uint64_t>) {
        to.u64(member);
    } else if constexpr (std::is_same_v<Member, std::string>) {
        to.text(member, field.count);
    } else {
        to.bytes(member);
    }
}

template <class Member>
void take(Member& member, const Field& field, RegisterReader& from) {
    if constexpr (is_word<Member>) {
        member = static_cast<Member>(from.u16());
    } else if constexpr (std::is_same_v<Member, std::uint32_t>) {
        member = from.u32();
    } else if constexpr (std::is_same_v<Member, std::int32_t>) {
        member = from.i32();
    } else if constexpr (std::is_same_v<Member, std::uint64_t>) {
        member = from.u64();
    } else if constexpr (std::is_same_v<Member, std::string>) {
        member = from.text(field.count);
    } else {
        from.bytes(member);
    }
}

template <class T, class Member>
Member member_of(Member T::*);
template <class T, class Member>
T owner_of(Member T::*);

// The field is the member `at`.
template <auto at>
constexpr auto bound(Field field, Part part = Part::value) {
    using T = decltype(owner_of(at));
    using Member = decltype(member_of(at));
    if (!fits<Member>(field)) throw "the field has another type or size than the member";
    return Row<T>{field, part, [](const T& from, const Field& f, RegisterWriter& to) { put(from.*at, f, to); },
                  [](T& to, const Field& f, RegisterReader& from) { take(to.*at, f, from); }};
}

// The field is one of the three numbers of the member `at`.
template <auto at, std::size_t axis>
constexpr auto bound_axis(Field field) {
    using T = decltype(owner_of(at));
    if (!fits<std::int32_t>(field)) throw "the field is no i32";
    return Row<T>{field, Part::value,
                  [](const T& from, const Field& f, RegisterWriter& to) { put((from.*at)[axis], f, to); },
                  [](T& to, const Field& f, RegisterReader& from) { take((to.*at)[axis], f, from); }};
}

// The field is always `word`.
template <class T, std::uint16_t word>
constexpr Row<T> fixed(Field field, Part part) {
    if (field.count != 1) throw "the field is no word";
    return {field, part, [](const T&, const Field&, RegisterWriter& to) { to.u16(word); },
            [](T&, const Field& f, RegisterReader& from) { from.skip(f.count); }};
}

template <class T>
constexpr Row<T> reserved(Field field) {
    return {field, Part::reserved, [](const T&, const Field& f, RegisterWriter& to) { to.zeros(f.count); },
            [](T&, const Field& f, RegisterReader& from) { from.skip(f.count); }};
}

// Over everything before it.
template <class T>
constexpr Row<T> checksum(Field field) {
    if (!fits<std::uint32_t>(field)) throw "the field is no u32";
    return {field, Part::crc, [](const T&, const Field&, RegisterWriter& to) { to.crc(); },
            [](T&, const Field& f, RegisterReader& from) { from.skip(f.count); }};
}

template <class T, std::size_t n>
constexpr std::array<Field, n> fields_of(const Row<T> (&rows)[n]) {
    std::array<Field, n> fields{};
    for (std::size_t i = 0; i < n; ++i) fields[i] = rows[i].field;
    return fields;
}

}  // namespace layout
}  // namespace qchopper
