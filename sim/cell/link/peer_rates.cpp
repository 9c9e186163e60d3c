// O(log addresses) for each request, O(addresses) to forget.

#include "sim/cell/link/peer_rates.h"

#include <algorithm>

namespace qchopper {

double PeerRates::left(const Bucket& bucket, LinkTime now) const {
    return std::min(burst_, bucket.left + per_second_ * seconds_between(bucket.at, now));
}

bool PeerRates::take(const std::string& peer, LinkTime now) {
    Bucket& bucket = buckets_.try_emplace(peer, Bucket{burst_, now}).first->second;
    bucket = {left(bucket, now), now};
    if (bucket.left < 1) return false;
    bucket.left -= 1;
    return true;
}

void PeerRates::forget(LinkTime now) {
    std::erase_if(buckets_, [&](const auto& one) { return left(one.second, now) >= burst_; });
}

}  // namespace qchopper
