// By the maximum flow of Boost (Y. Boykov and V. Kolmogorov, "An experimental comparison of min-cut/max-flow algorithms
// for energy minimization in vision", 2004). Only this source sees Boost's graphs.

#include "segment/regions/engines/minimum_cut.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>

namespace qchopper {
namespace {

using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
using Flow = boost::adjacency_list<
    boost::vecS, boost::vecS, boost::directedS,
    boost::property<boost::vertex_color_t, boost::default_color_type,
                    boost::property<boost::vertex_distance_t, long,
                                    boost::property<boost::vertex_predecessor_t, Traits::edge_descriptor>>>,
    boost::property<boost::edge_capacity_t, double,
                    boost::property<boost::edge_residual_capacity_t, double,
                                    boost::property<boost::edge_reverse_t, Traits::edge_descriptor>>>>;

void connect(Flow& flow, std::size_t a, std::size_t b, double there, double back) {
    const auto forth = boost::add_edge(a, b, flow).first;
    const auto reverse = boost::add_edge(b, a, flow).first;
    boost::put(boost::edge_capacity, flow, forth, there);
    boost::put(boost::edge_capacity, flow, reverse, back);
    boost::put(boost::edge_reverse, flow, forth, reverse);
    boost::put(boost::edge_reverse, flow, reverse, forth);
}

}  // namespace

MinimumCut minimum_cut(std::size_t elements, std::span<const CutEdge> edges, std::span<const std::uint32_t> sources,
                       std::span<const std::uint32_t> sinks) {
    Flow flow(elements + 2);
    const std::size_t source = elements;
    const std::size_t sink = elements + 1;
    double more_than_all = 1;
    for (const CutEdge& edge : edges) {
        connect(flow, edge.a, edge.b, edge.capacity, edge.capacity);
        more_than_all += edge.capacity;
    }
    for (const std::uint32_t e : sources) connect(flow, source, e, more_than_all, 0);
    for (const std::uint32_t e : sinks) connect(flow, e, sink, more_than_all, 0);
    MinimumCut cut;
    cut.weight = boost::boykov_kolmogorov_max_flow(flow, source, sink);
    const auto of_source = boost::get(boost::vertex_color, flow, source);
    for (std::size_t e = 0; e < elements; ++e) {
        cut.is_with_sources.push_back(boost::get(boost::vertex_color, flow, e) == of_source);
    }
    return cut;
}

}  // namespace qchopper
