// All setup sheets of an order as one document: an index with totals, then one page for each job.
//
// Made from the job files alone, with their pictures inside. Lengths in mm. Same jobs, same bytes
// (tests/cam/job/sheet/order_sheets_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cam/job/job.h"

namespace qchopper {

// What the document takes of a job.
struct SheetOfOrder {
    std::string file;   // name of the job file
    std::string state;  // for people: "ready"
    std::string piece;
    JobPart part;
    std::string block_name;
    Vec3 block;  // its size as it stands
    bool is_sawn = false;
    std::vector<std::uint16_t> tools;  // numbers, ascending, of the program; none without one
    std::uint32_t time_s = 0;          // estimated
    double unreachable_share = 0;
    double foam_mm3 = 0;            // that stays and is taken off by hand; 0 where it is not known
    std::size_t holes_by_hand = 0;  // for dowels
    std::string page;               // HTML of its setup sheet, with the pictures inside; empty: it has none
};

// `file`: its name; `state`: a word for the index.
SheetOfOrder sheet_of(const ReadJob& job, const std::string& file, const std::string& state);

// Names of the pieces that have none.
struct PiecesWithoutJob {
    std::vector<std::string> others;     // they do not fit
    std::vector<std::string> only_sawn;  // the saw alone makes them
};

// HTML. `order`: what people call it.
std::string order_sheets(const std::string& order, std::span<const SheetOfOrder> sheets,
                         const PiecesWithoutJob& without_job);

}  // namespace qchopper
