// The lines that are typed or sent on standard input, without waiting for them.
//
// In the background of a terminal nothing is read: the process would be stopped.

#pragma once

#include <optional>
#include <string>

namespace qchopper {

class StandardInputLines {
 public:
    // The next whole line, or the rest at the end of the input. Nothing if there is none yet.
    std::optional<std::string> next();
    bool has_ended() const { return has_ended_ && rest_.empty(); }

 private:
    void read_more();

    std::string rest_;
    bool has_ended_ = false;
};

}  // namespace qchopper
