// How many requests the clients at one address may send: a token bucket (J. Turner: New Directions in Communications,
// 1986) for each address.

#pragma once

#include <map>
#include <string>

#include "sim/cell/link/modbus_connection.h"

namespace qchopper {

class PeerRates {
 public:
    // `burst` at once, `per_second` in the long run; both > 0.
    PeerRates(double per_second, double burst) : per_second_(per_second), burst_(burst) {}
    // True: one request may be answered now, and is counted.
    bool take(const std::string& peer, LinkTime now);
    // Addresses that have used nothing of late are forgotten.
    void forget(LinkTime now);
    std::size_t peers() const { return buckets_.size(); }

 private:
    struct Bucket {
        double left = 0;
        LinkTime at;
    };
    double left(const Bucket& bucket, LinkTime now) const;

    double per_second_;
    double burst_;
    std::map<std::string, Bucket> buckets_;
};

}  // namespace qchopper
