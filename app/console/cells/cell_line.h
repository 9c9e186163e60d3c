// The connections of the console to one cell: one reads its status, one is kept for Hold alone, and each other command
// has one of its own.
//
// Functions may be called from any thread (tests/app/console/cell_line_test.cpp).

#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/console/cells/cell_view.h"
#include "app/console/worker/worker.h"
#include "app/dispatch/contact_cell.h"
#include "devices/wire/blocks.h"

namespace qchopper {

std::string to_json(const CellView& view);

// What STATUS says of the fields that the page shows: the link is there.
void take_status(const Status& status, CellView& view);

class CellLine {
 public:
    // `cell_file`: of which the cell at `address` has to be the one; nothing: any. `on_change` is called by a thread of
    // this object when what is shown has changed, and every two seconds.
    CellLine(std::string id, std::string address, std::string name, std::optional<std::filesystem::path> cell_file,
             std::function<void(const CellView&)> on_change);
    ~CellLine();
    CellLine(const CellLine&) = delete;
    CellLine& operator=(const CellLine&) = delete;

    CellView view() const;
    // Over the connection that is kept open for it.
    WorkerAnswer hold();
    // unhold, stop, abort, clear or reset. `job`: what the person saw in the cell, which must still be there; empty:
    // none.
    WorkerAnswer command(const std::string& action, const std::string& job);

 private:
    using Contact = std::unique_ptr<ContactedCell>;
    Contact contact() const;
    // Reads STATUS over a connection, which is made if there is none; throws DeviceError, InputError.
    void read(Contact& over) const;
    WorkerAnswer send(Contact& over, const std::string& action, const std::optional<std::string>& job);
    void watch(const std::stop_token& stop);
    void keep_hold_open(const std::stop_token& stop);
    void look();
    void wait(const std::stop_token& stop, std::chrono::milliseconds time);

    const std::string address_;
    const std::optional<std::filesystem::path> cell_file_;
    const std::function<void(const CellView&)> on_change_;

    mutable std::mutex showing_;
    CellView view_;
    std::optional<std::chrono::steady_clock::time_point> read_at_;

    Contact reader_;  // of the thread that watches
    std::mutex holding_;
    Contact holder_;

    std::mutex waiting_;
    std::condition_variable_any ended_;
    std::jthread watcher_;  // the last members: they end before the others
    std::jthread keeper_;
};

}  // namespace qchopper
