// How another program of the same user asks a running dispatcher to pass Unhold or Clear to the cell: one line to a
// Unix socket in the folder of the cell's journal, one line back: "OK", "refused: " and why, or what is known
// otherwise.
//
// Only the owner of the folder can reach the socket. The dispatcher never waits for a client
// (tests/devices/hand_off/request_socket_test.cpp).

#pragma once

#include <filesystem>
#include <string>

#include "devices/hand_off/dispatch_options.h"
#include "devices/wire/packml.h"

namespace qchopper {

class RequestSocket {
 public:
    // Listens in `folder`. Precondition: the journal there is held, so that no other dispatcher listens. If the system
    // refuses, is_open() is false and there are no requests.
    explicit RequestSocket(const std::filesystem::path& folder);
    ~RequestSocket();
    RequestSocket(const RequestSocket&) = delete;
    RequestSocket& operator=(const RequestSocket&) = delete;

    bool is_open() const { return listener_ >= 0; }
    // Unhold or Clear if a client has asked for it, none otherwise; each request once. Anything else that a client
    // sends is answered with a refusal here.
    CellCommand next();
    // To the client whose request next() returned last.
    void answer(const RequestAnswer& answer);

 private:
    void accept_client();
    std::filesystem::path path_;
    int listener_ = -1;
    int client_ = -1;
    bool is_asked_ = false;
    std::string line_;
};

// The line of an answer.
std::string describe(const RequestAnswer& answer);

// Asks the dispatcher that holds the journal in `folder`, and waits for its answer, at most patience_s seconds. Throws
// DeviceError (busy) if none listens or answers.
RequestAnswer ask_dispatcher(const std::filesystem::path& folder, CellCommand command, double patience_s);

}  // namespace qchopper
