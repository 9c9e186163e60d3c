// What `qchopper cell` shows: what the cell says of itself, or how it answered a command. O(1).

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "devices/journal/journal_event.h"
#include "devices/wire/blocks.h"

namespace qchopper {

struct CellStatusReport {
    std::string endpoint;
    Status status;
    std::optional<SeenStore> store;  // as the cell shows it; nothing if it cannot be read
    bool has_journal = false;        // of this cell, on this computer
    std::string store_loss;          // what shows that the cell lost its memory, or empty
};
std::vector<std::string> lines(const CellStatusReport& report);
std::string document(const CellStatusReport& report);

struct CellControlReport {
    std::string endpoint;
    std::string action;  // "hold"
    std::string end;     // "done", "refused", "unknown"
    std::string why;
    std::string result;  // "LOCAL_CONTROL", or empty
    std::string note;    // what the operator must know of the action, or empty
    std::string to_do;   // empty if it was done
    bool simulated = false;
    std::string state;  // of the machine, last read
};
std::vector<std::string> lines(const CellControlReport& report);
std::string document(const CellControlReport& report);

}  // namespace qchopper
