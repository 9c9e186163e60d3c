// O(log(answers kept)) a request.

#include "app/console/http/kept_answers.h"

namespace qchopper {

HttpAnswer KeptAnswers::answer(const std::string& id, const Sha256& request, const std::function<HttpAnswer()>& make,
                               const HttpAnswer& conflict) {
    {
        std::unique_lock lock(changing_);
        auto found = kept_.find(id);
        if (found != kept_.end()) {
            if (found->second.request != request) return conflict;
            made_.wait(lock, [&] {
                found = kept_.find(id);
                return found == kept_.end() || found->second.is_made;
            });
            return found == kept_.end() ? conflict : found->second.answer;
        }
        kept_.emplace(id, Kept{request});
    }
    HttpAnswer made = make();
    {
        const std::lock_guard lock(changing_);
        Kept& kept = kept_.at(id);
        kept.answer = made;
        kept.is_made = true;
        order_.push_back(id);
        bytes_ += made.body.size();
        drop_old();
    }
    made_.notify_all();
    return made;
}

// Precondition: it is locked.
void KeptAnswers::drop_old() {
    while (order_.size() > most_ || (order_.size() > 1 && bytes_ > most_bytes_)) {
        const auto oldest = kept_.find(order_.front());
        bytes_ -= oldest->second.answer.body.size();
        kept_.erase(oldest);
        order_.pop_front();
    }
}

}  // namespace qchopper
