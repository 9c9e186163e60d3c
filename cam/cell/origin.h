// Where a value of a cell file comes from.

#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace qchopper {

enum class Origin {
    data_sheet,  // the maker's data sheet, or a published model of this type
    measured,    // on this cell
    assumed,     // plausible for its class; nobody has checked it on this cell
    unstated,    // the file gives the value without its origin
    by_default   // the file gives no value
};

struct ValueOrigin {
    std::string table;  // "robot", "tool 3", "stock large"; empty for a key outside of all tables
    std::string key;
    Origin origin = Origin::unstated;
    bool operator==(const ValueOrigin&) const = default;
};

// "data sheet", "measured", "assumed", "unstated", "by default"
std::string_view to_word(Origin origin);

// Of the first three only.
std::optional<Origin> origin_of(std::string_view word);

}  // namespace qchopper
