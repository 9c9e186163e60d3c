// The progress of a loop whose items run on several threads (base/parallel.h): one sum, reported from one thread at a
// time. The context must outlive it (tests/base/shared_progress_test.cpp).

#pragma once

#include <mutex>
#include <string>
#include <utility>

#include "base/context.h"

namespace qchopper {

class SharedProgress {
 public:
    // Reports that nothing is done yet, if there is anything to do.
    SharedProgress(const Context& context, std::string what, std::size_t total)
        : context_(context), what_(std::move(what)), total_(total) {
        if (total_ > 0) context_.progress(what_, 0, total_);
    }

    void add(std::size_t done) {
        const std::lock_guard lock(reporting_);
        report(done);
    }

    // For one of several parts that count items themselves: what it reports as done is added, it is cancelled with the
    // others, and sends no messages. `total` is then the sum over all parts.
    Context of_part() {
        Context context;
        context.cancelled = context_.cancelled;
        context.on_progress = [this, before = std::size_t{0}](const Progress& p) mutable {
            const std::lock_guard lock(reporting_);
            report(p.done - before);
            before = p.done;
        };
        return context;
    }

 private:
    void report(std::size_t newly) {
        done_ += newly;
        context_.progress(what_, done_, total_);
    }

    const Context& context_;
    const std::string what_;
    const std::size_t total_;
    std::size_t done_ = 0;
    std::mutex reporting_;
};

}  // namespace qchopper
