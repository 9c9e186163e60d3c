// link_fuzz REQUESTS STREAMS [SEED]: so many fuzzed requests to the simulated cell's PDU handler and so many fuzzed
// streams to its framing. Ends the program where a condition of cell_steps.h or stream_steps.h does not hold.
//
// Half of the inputs are seeds of the fuzzers (link_seeds.cpp) with some bytes changed, removed or repeated, half are
// random bytes. The same seed gives the same inputs. O(bytes).

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <span>

#include "tests/fuzz/cell_steps.h"
#include "tests/fuzz/seeds.h"
#include "tests/fuzz/stream_steps.h"

namespace qchopper {
namespace {

class Inputs {
 public:
    Inputs(const std::string& reader, std::uint64_t seed) : random_(seed) {
        for (const Encoded& one : link_seeds()) {
            if (one.reader == reader) seeds_.push_back(one.bytes);
        }
        demand(!seeds_.empty());
    }
    std::size_t below(std::size_t count) { return random_() % count; }
    Bytes next() {
        if (below(2) == 0) return any(1 + below(600));
        Bytes bytes = seeds_[below(seeds_.size())];
        for (std::size_t n = 1 + below(6); n > 0 && !bytes.empty(); --n) change(bytes);
        return bytes;
    }

 private:
    Bytes any(std::size_t count) {
        Bytes bytes(count);
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random_());
        return bytes;
    }
    void change(Bytes& bytes) {
        const auto at = static_cast<std::ptrdiff_t>(below(bytes.size()));
        const auto count = static_cast<std::ptrdiff_t>(
            std::min<std::size_t>(1 + below(20), bytes.size() - static_cast<std::size_t>(at)));
        const Bytes part(bytes.begin() + at, bytes.begin() + at + count);
        switch (below(4)) {
            case 0:
                bytes[static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(random_());
                break;
            case 1:
                bytes[static_cast<std::size_t>(at)] ^= static_cast<std::uint8_t>(1U << below(8));
                break;
            case 2:
                bytes.erase(bytes.begin() + at, bytes.begin() + at + count);
                break;
            default:
                bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size())), part.begin(),
                             part.end());
        }
    }

    std::mt19937_64 random_;
    std::vector<Bytes> seeds_;
};

std::uint64_t fuzz_requests(std::uint64_t wanted, std::uint64_t seed) {
    Inputs inputs("pdu", seed);
    std::uint64_t requests = 0;
    while (requests < wanted) {
        const Bytes bytes = inputs.next();
        Input input(bytes.data(), bytes.size());
        CellSteps cell;
        cell.run(input);
        requests += cell.requests();
    }
    return requests;
}

std::uint64_t fuzz_streams(std::uint64_t wanted, std::uint64_t seed) {
    Inputs inputs("stream", seed);
    std::uint64_t requests = 0;
    for (std::uint64_t n = 0; n < wanted; ++n) {
        const Bytes bytes = inputs.next();
        const std::size_t head = std::min<std::size_t>(1, bytes.size());  // is for fuzz_stream.cpp
        requests += check_stream(std::span(bytes).subspan(head), [&] { return 1 + inputs.below(40); });
    }
    demand(wanted < 1000 || requests > wanted / 2);  // else the seeds are none any more
    return requests;
}

}  // namespace
}  // namespace qchopper

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fputs("usage: link_fuzz REQUESTS STREAMS [SEED]\n", stderr);
        return 64;
    }
    const std::uint64_t seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
    const std::uint64_t streams = std::strtoull(argv[2], nullptr, 10);
    const std::uint64_t requests = qchopper::fuzz_requests(std::strtoull(argv[1], nullptr, 10), seed);
    const std::uint64_t framed = qchopper::fuzz_streams(streams, seed);
    std::printf("%llu requests to the PDU handler, %llu streams with %llu requests in them: nothing found\n",
                static_cast<unsigned long long>(requests), static_cast<unsigned long long>(streams),
                static_cast<unsigned long long>(framed));
    return 0;
}
