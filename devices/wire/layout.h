// The rows of the tables in registers.cpp: how each field of a block is written from a value and read into one.
//
// A row binds a field to a member. That the types and sizes of both agree is checked when the table is compiled: the
// constexpr functions below throw, which is no constant expression. Rows stand in the order of their addresses.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>

#include "devices/wire/blocks.h"
#include "devices/wire/field.h"
#include "devices/wire/register_writer.h"

namespace qchopper {

// What a field is for: a value, or one of the marks of its block.
enum class FieldRole : std::uint8_t { value, magic, version, snap_begin, snap_end, crc, reserved };

// `write` appends the registers of the field, `read` consumes them.
template <class T>
struct LayoutRow {
    Field field;
    FieldRole role;
    void (*write)(const T& from, const Field& field, RegisterWriter& to);
    void (*read)(T& to, const Field& field, RegisterReader& from);
};

// The table of the block of a T; defined in registers.cpp.
template <class T>
std::span<const LayoutRow<T>> rows_of();

namespace layout {

template <class Member>
constexpr bool is_one_register = (std::is_enum_v<Member> || std::is_unsigned_v<Member>)&&sizeof(Member) == 2;

template <class Member>
constexpr bool fits(const Field& field) {
    if constexpr (is_one_register<Member>) return field.type == FieldType::u16 && field.count == 1;
    if constexpr (std::is_same_v<Member, std::uint32_t>) return field.type == FieldType::u32 && field.count == 2;
    if constexpr (std::is_same_v<Member, std::int32_t>) return field.type == FieldType::i32 && field.count == 2;
    if constexpr (std::is_same_v<Member, std::uint64_t>) return field.type == FieldType::u64 && field.count == 4;
    if constexpr (std::is_same_v<Member, std::string>) return field.type == FieldType::text;
    if constexpr (std::is_same_v<Member, Uuid> || std::is_same_v<Member, Sha256> ||
                  std::is_same_v<Member, Ed25519Signature>) {
        return field.type == FieldType::bytes && sizeof(Member) == 2U * field.count;
    }
    return false;
}

template <class Member>
void write(const Member& member, const Field& field, RegisterWriter& to) {
    if constexpr (is_one_register<Member>) {
        to.u16(static_cast<std::uint16_t>(member));
    } else if constexpr (std::is_same_v<Member, std::uint32_t>) {
        to.u32(member);
    } else if constexpr (std::is_same_v<Member, std::int32_t>) {
        to.i32(member);
    } else if constexpr (std::is_same_v<Member, std::uint64_t>) {
        to.u64(member);
    } else if constexpr (std::is_same_v<Member, std::string>) {
        to.text(member, field.count);
    } else if constexpr (std::is_same_v<Member, Sha256> || std::is_same_v<Member, Ed25519Signature>) {
        to.bytes(member.bytes);
    } else {
        to.bytes(member);
    }
}

template <class Member>
void read(Member& member, const Field& field, RegisterReader& from) {
    if constexpr (is_one_register<Member>) {
        member = static_cast<Member>(from.u16());
    } else if constexpr (std::is_same_v<Member, std::uint32_t>) {
        member = from.u32();
    } else if constexpr (std::is_same_v<Member, std::int32_t>) {
        member = from.i32();
    } else if constexpr (std::is_same_v<Member, std::uint64_t>) {
        member = from.u64();
    } else if constexpr (std::is_same_v<Member, std::string>) {
        member = from.text(field.count);
    } else if constexpr (std::is_same_v<Member, Sha256> || std::is_same_v<Member, Ed25519Signature>) {
        from.bytes(member.bytes);
    } else {
        from.bytes(member);
    }
}

template <class T, class Member>
Member member_of(Member T::*);
template <class T, class Member>
T owner_of(Member T::*);

// The field holds the member `at` of a T; T must be given if a base of T declares the member.
template <auto at, class T = decltype(owner_of(at))>
constexpr auto bound(Field field, FieldRole role = FieldRole::value) {
    using Member = decltype(member_of(at));
    if (!fits<Member>(field)) throw "the field has another type or size than the member";
    return LayoutRow<T>{field, role, [](const T& from, const Field& f, RegisterWriter& to) { write(from.*at, f, to); },
                        [](T& to, const Field& f, RegisterReader& from) { read(to.*at, f, from); }};
}

// The field holds one of the three numbers of the member `at`.
template <auto at, std::size_t axis>
constexpr auto bound_axis(Field field) {
    using T = decltype(owner_of(at));
    if (!fits<std::int32_t>(field)) throw "the field is no i32";
    return LayoutRow<T>{field, FieldRole::value,
                        [](const T& from, const Field& f, RegisterWriter& to) { write((from.*at)[axis], f, to); },
                        [](T& to, const Field& f, RegisterReader& from) { read((to.*at)[axis], f, from); }};
}

// The field always holds `value`; what is read there is ignored.
template <class T, std::uint16_t value>
constexpr LayoutRow<T> fixed(Field field, FieldRole role) {
    if (field.count != 1) throw "the field is not one register";
    return {field, role, [](const T&, const Field&, RegisterWriter& to) { to.u16(value); },
            [](T&, const Field& f, RegisterReader& from) { from.skip(f.count); }};
}

// Written as zeros; what is read there is ignored.
template <class T>
constexpr LayoutRow<T> reserved(Field field) {
    return {field, FieldRole::reserved, [](const T&, const Field& f, RegisterWriter& to) { to.zeros(f.count); },
            [](T&, const Field& f, RegisterReader& from) { from.skip(f.count); }};
}

// CRC-32 over all registers of the block before it.
template <class T>
constexpr LayoutRow<T> checksum(Field field) {
    if (!fits<std::uint32_t>(field)) throw "the field is no u32";
    return {field, FieldRole::crc, [](const T&, const Field&, RegisterWriter& to) { to.crc(); },
            [](T&, const Field& f, RegisterReader& from) { from.skip(f.count); }};
}

// Each begins where the one before ends.
template <class T, std::size_t n>
constexpr std::array<Field, n> fields_of(const LayoutRow<T> (&rows)[n]) {
    std::array<Field, n> fields{};
    for (std::size_t i = 0; i < n; ++i) {
        fields[i] = rows[i].field;
        const bool is_next = i == 0 || fields[i].address == fields[i - 1].address + fields[i - 1].count;
        if (!is_next) throw "there is a gap before the field";
    }
    return fields;
}

}  // namespace layout
}  // namespace qchopper
