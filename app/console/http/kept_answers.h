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
    explicit KeptAnswers(std::size_t kept = 1000) : most_(kept) {}

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

    std::size_t most_;
    std::mutex changing_;
    std::condition_variable made_;
    std::map<std::string, Kept> kept_;
    std::deque<std::string> order_;  // of those that are made, the oldest first
};

}  // namespace qchopper
