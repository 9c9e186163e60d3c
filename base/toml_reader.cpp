// Wraps toml++. Each value is checked when it is read; keys are compared with all known ones, which are few.
// O(text) to parse; O(keys x known keys) for a table.

#include "base/toml_reader.h"

#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "base/edit_distance.h"
#include "base/error.h"

namespace qchopper {

struct TomlReader::Table {
    std::shared_ptr<const toml::table> whole;
    const toml::table* keys;
};

namespace {

std::string place(const std::string& file, const toml::node& node) {
    const auto line = node.source().begin.line;
    return line > 0 ? file + ":" + std::to_string(line) : file;
}

std::string kind(const toml::node& node) {
    if (node.is_table()) return "a table";
    if (node.is_array()) return "a list";
    if (node.is_string()) return "a text";
    if (node.is_boolean()) return "true or false";
    return node.is_number() ? "a number" : "a date or time";
}

// The shortest digits that give the number again, under any locale.
std::string shortest(double value) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    return {text, end};
}

std::string_view nearest(std::string_view key, Keys known) {
    return *std::min_element(known.begin(), known.end(), [&](std::string_view a, std::string_view b) {
        return edit_distance(key, a) < edit_distance(key, b);
    });
}

// Names from a file appear in messages and sheets, where control characters could overwrite other text.
std::string printable(std::string_view text, std::size_t longest = 60) {
    std::string clean(text.substr(0, longest));
    std::replace_if(
        clean.begin(), clean.end(), [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; }, '?');
    return clean;
}

double checked(const TomlReader& reader, std::string_view key, const toml::node& node, double least, double most) {
    if (!node.is_number()) reader.refuse(key, "must be a number, not " + kind(node));
    const double value = *node.value<double>();
    if (!std::isfinite(value)) reader.refuse(key, "must be a finite number");
    if (value < least || value > most) {
        reader.refuse(key, shortest(value) + " is out of bounds, " + shortest(least) + " to " + shortest(most));
    }
    return value;
}

const toml::node& need(const TomlReader& reader, const toml::table& table, std::string_view key) {
    const toml::node* node = table.get(key);
    if (node == nullptr) reader.refuse(key, "is missing", "add the key; docs/user/cell-file.md explains each");
    return *node;
}

}  // namespace

TomlReader::TomlReader(std::shared_ptr<const Table> table, std::string file, std::string prefix)
    : table_(std::move(table)), file_(std::move(file)), prefix_(std::move(prefix)) {}

TomlReader TomlReader::with_keys(Keys known) const {
    for (const auto& [key, node] : *table_->keys) {
        const std::string_view name = key.str();
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        const std::string shown = printable(name);
        throw InputError(InputFault::config, place(file_, node) + ": unknown key " + prefix_ + shown,
                         "did you mean " + prefix_ + std::string(nearest(shown, known)) + "?");
    }
    return *this;
}

TomlReader TomlReader::parse(std::string_view text, const std::string& file, Keys known) {
    return parse(text, file).with_keys(known);
}

TomlReader TomlReader::parse(std::string_view text, const std::string& file) {
    try {
        auto whole = std::make_shared<const toml::table>(toml::parse(text, file));
        const toml::table* keys = whole.get();
        return {std::make_shared<const Table>(Table{std::move(whole), keys}), file, ""};
    } catch (const toml::parse_error& error) {
        throw InputError(InputFault::config,
                         file + ":" + std::to_string(error.source().begin.line) + ": not TOML from column " +
                             std::to_string(error.source().begin.column) +
                             " on: a value, bracket, comma or quotation mark is missing or too many",
                         "docs/user/cell-file.md shows a whole cell file");
    }
}

bool TomlReader::has(std::string_view key) const {
    return table_->keys->contains(key);
}

void TomlReader::refuse(std::string_view key, const std::string& why, const std::string& to_do) const {
    const toml::node* node = table_->keys->get(key);
    throw InputError(InputFault::config,
                     place(file_, node != nullptr ? *node : static_cast<const toml::node&>(*table_->keys)) + ": " +
                         full(key) + ": " + why,
                     to_do);
}

std::string TomlReader::text(std::string_view key, std::size_t longest) const {
    const toml::node& node = need(*this, *table_->keys, key);
    const auto* value = node.as_string();
    if (value == nullptr) refuse(key, "must be a text in quotes, not " + kind(node));
    if (value->get().empty()) refuse(key, "must not be empty");
    if (printable(value->get(), longest) != value->get()) {
        refuse(key, "must be one line of at most " + std::to_string(longest) + " characters");
    }
    return value->get();
}

bool TomlReader::boolean(std::string_view key) const {
    const toml::node& node = need(*this, *table_->keys, key);
    if (!node.is_boolean()) refuse(key, "must be true or false, not " + kind(node));
    return node.as_boolean()->get();
}

double TomlReader::number(std::string_view key, double least, double most) const {
    return checked(*this, key, need(*this, *table_->keys, key), least, most);
}

void TomlReader::number_if_given(std::string_view key, double least, double most, double& value) const {
    if (has(key)) value = number(key, least, most);
}

std::uint32_t TomlReader::whole(std::string_view key, std::uint32_t least, std::uint32_t most) const {
    const toml::node& node = need(*this, *table_->keys, key);
    if (!node.is_integer())
        refuse(key, "must be a whole number, not " + (node.is_number() ? "a fraction" : kind(node)));
    return static_cast<std::uint32_t>(checked(*this, key, node, least, most));
}

std::vector<double> TomlReader::numbers(std::string_view key, std::size_t count, double least, double most) const {
    const toml::node& node = need(*this, *table_->keys, key);
    const toml::array* list = node.as_array();
    if (list == nullptr || list->size() != count) {
        refuse(key, "must be a list of " + std::to_string(count) + " numbers" +
                        (list == nullptr ? ", not " + kind(node) : ", not of " + std::to_string(list->size())));
    }
    return numbers(key, least, most);
}

std::vector<double> TomlReader::numbers(std::string_view key, double least, double most) const {
    const toml::node& node = need(*this, *table_->keys, key);
    if (!node.is_array()) refuse(key, "must be a list of numbers, not " + kind(node));
    std::vector<double> values;
    for (const toml::node& element : *node.as_array()) values.push_back(checked(*this, key, element, least, most));
    return values;
}

std::vector<std::string> TomlReader::texts(std::string_view key) const {
    const toml::node& node = need(*this, *table_->keys, key);
    if (!node.is_array()) refuse(key, "must be a list of texts in quotes, not " + kind(node));
    std::vector<std::string> values;
    for (const toml::node& element : *node.as_array()) {
        if (!element.is_string()) refuse(key, "must be a list of texts in quotes, not of " + kind(element));
        values.push_back(element.as_string()->get());
    }
    return values;
}

std::vector<std::array<double, 2>> TomlReader::pairs(std::string_view key, double least, double most) const {
    const toml::node& node = need(*this, *table_->keys, key);
    if (!node.is_array()) refuse(key, "must be a list of lists of two numbers, not " + kind(node));
    std::vector<std::array<double, 2>> values;
    for (const toml::node& element : *node.as_array()) {
        const toml::array* pair = element.as_array();
        if (pair == nullptr || pair->size() != 2) refuse(key, "must be a list of lists of two numbers");
        values.push_back(
            {checked(*this, key, *pair->get(0), least, most), checked(*this, key, *pair->get(1), least, most)});
    }
    return values;
}

Vec3 TomlReader::vector(std::string_view key, double least, double most) const {
    const std::vector<double> v = numbers(key, 3, least, most);
    return {v[0], v[1], v[2]};
}

TomlReader TomlReader::table(std::string_view key, Keys known) const {
    const toml::node& node = need(*this, *table_->keys, key);
    if (!node.is_table()) refuse(key, "must be a table [" + full(key) + "], not " + kind(node));
    const TomlReader reader(std::make_shared<const Table>(Table{table_->whole, node.as_table()}), file_,
                            full(key) + ".");
    return reader.with_keys(known);
}

TomlReader TomlReader::table_if_given(std::string_view key, Keys known) const {
    static const toml::table none;
    if (has(key)) return table(key, known);
    return {std::make_shared<const Table>(Table{table_->whole, &none}), file_, full(key) + "."};
}

std::vector<TomlReader> TomlReader::tables(std::string_view key, Keys known) const {
    const toml::node& node = need(*this, *table_->keys, key);
    const toml::array* list = node.as_array();
    if (list == nullptr) refuse(key, "must be tables [[" + full(key) + "]], not " + kind(node));
    std::vector<TomlReader> readers;
    for (const toml::node& element : *list) {
        if (!element.is_table()) refuse(key, "must be tables [[" + full(key) + "]], not " + kind(element));
        const TomlReader reader(std::make_shared<const Table>(Table{table_->whole, element.as_table()}), file_,
                                full(key) + ".");
        readers.push_back(reader.with_keys(known));
    }
    return readers;
}

}  // namespace qchopper
