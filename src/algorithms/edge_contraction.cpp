#include "algorithms/edge_contraction.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

#include "algorithms/pair_sums.h"

namespace tufted {
namespace {

/// A set is named by one of its points. It has a circular list of edges that leave it, among them one at least to each
/// neighbouring set. This takes a third of the memory of a map of sums for each set.
class Contraction {
 public:
  Contraction(const std::vector<SignedEdge>& edges, SignedSets& sets)
      : edges_(edges), sets_(sets), sums_(edges.size()), next_(2 * edges.size()) {
    const auto n = static_cast<std::size_t>(sets.size());
    last_.assign(n, -1);
    neighbors_.assign(n, 0);
    name_.resize(n);
    std::iota(name_.begin(), name_.end(), 0);
    std::vector<Pair> pairs;
    pairs.reserve(edges.size());
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto& [low, high, alike] = edges[e];
      sums_.at(low, high) = alike;
      pairs.push_back({std::abs(alike), low, high});
      append(low, static_cast<int>(2 * e));
      append(high, static_cast<int>(2 * e + 1));
      ++neighbors_[low], ++neighbors_[high];
    }
    queue_ = std::priority_queue<Pair>({}, std::move(pairs));
  }

  void run(const Workers& workers) {
    // Pairs of sets between two calls of `progress`.
    constexpr std::size_t between_reports = 65536;
    for (std::size_t count = 0; !queue_.empty(); ++count) {
      if (count % between_reports == 0)
        workers.report("orient", std::min(1.0, static_cast<double>(joined_) / static_cast<double>(name_.size())));
      const auto [certainty, a, b] = queue_.top();
      queue_.pop();
      const double* const alike = sums_.find(a, b);
      if (alike != nullptr && std::abs(*alike) == certainty) contract(a, b, *alike);
    }
  }

 private:
  struct Pair {
    double certainty;
    int a, b;

    friend bool operator<(const Pair& p, const Pair& q) {
      return std::tie(p.certainty, q.a, q.b) < std::tie(q.certainty, p.a, p.b);
    }
  };

  /// The name of the set that an edge leads to. Edge e is left by 2 e from its lower point, by 2 e + 1 from its higher.
  int target(int leaving) {
    const SignedEdge& edge = edges_[leaving / 2];
    return name_[sets_.root(leaving % 2 == 0 ? edge.high : edge.low)];
  }

  void append(int set, int leaving) {
    int& last = last_[set];
    next_[leaving] = last < 0 ? leaving : std::exchange(next_[last], leaving);
    last = leaving;
  }

  void contract(int a, int b, double alike) {
    ++joined_;
    if (neighbors_[a] < neighbors_[b]) std::swap(a, b);
    sums_.erase(a, b);
    --neighbors_[a];
    sets_.unite(a, b, alike < 0);
    name_[sets_.root(a)] = a;
    const int end = last_[b];
    for (int leaving = next_[end], next = 0, is_last = 0; is_last == 0; leaving = next) {
      next = next_[leaving];
      is_last = leaving == end ? 1 : 0;
      const int c = target(leaving);
      const double* const found = c == a ? nullptr : sums_.find(b, c);
      if (found == nullptr) continue;  // an edge within the set, or a further one to a neighbouring set
      const double weight = alike < 0 ? -*found : *found;
      sums_.erase(b, c);
      if (sums_.find(a, c) != nullptr) {
        --neighbors_[c];
      } else {
        ++neighbors_[a];
        append(a, leaving);
      }
      const double sum = sums_.at(a, c) += weight;
      queue_.push({std::abs(sum), std::min(a, c), std::max(a, c)});
    }
  }

  const std::vector<SignedEdge>& edges_;
  SignedSets& sets_;
  PairSums sums_;               ///< between neighbouring sets
  std::vector<int> next_;       ///< the next edge that leaves the same set
  std::vector<int> last_;       ///< by name: the last edge that leaves the set, -1: none
  std::vector<int> neighbors_;  ///< by name: number of neighbouring sets
  std::vector<int> name_;       ///< by root
  std::priority_queue<Pair> queue_;
  std::size_t joined_ = 0;
};

}  // namespace

void contractEdges(const std::vector<SignedEdge>& edges, SignedSets& sets, const Workers& workers) {
  Contraction(edges, sets).run(workers);
}

}  // namespace tufted
