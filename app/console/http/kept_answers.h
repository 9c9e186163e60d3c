// The answers to requests that change something, by their ids, so that a request that is sent again does nothing again.
//
// All functions may be called from any thread (tests/app/console/kept_answers_test.cpp).

#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "app/console/http/http_message.h"
#include "base/sha256.h"

namespace qchopper {

class KeptAnswers {
 public:
    // The newest so many answers are kept, as far as their bodies are not more bytes together; the newest one always.
    explicit KeptAnswers(std::size_t kept = 1000, std::size_t bytes = 32'000'000) : most_(kept), most_bytes_(bytes) {}

    // The answer that was made for this id, or the one that `make` makes now; one that is being made is waited for.
    // `request`: the bytes that the id stands for. An id with another request is answered with `conflict`.
    HttpAnswer answer(const std::string& id, const Sha256& request, const std::function<HttpAnswer()>& make,
                      const HttpAnswer& conflict);

 private:
    struct Kept {
        Sha256 request;
        bool is_made = false;
        HttpAnswer answer = {};
    };

    void drop_old();

    std::size_t most_;
    std::size_t most_bytes_;
    std::size_t bytes_ = 0;  // of the bodies of those that are made
    std::mutex changing_;
    std::condition_variable made_;
    std::map<std::string, Kept> kept_;
    std::deque<std::string> order_;  // of those that are made, the oldest first
};

}  // namespace qchopper
