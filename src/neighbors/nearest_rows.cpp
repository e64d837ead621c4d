#include "neighbors/nearest_rows.h"

#include <flann/util/result_set.h>

#include <limits>

#include "neighbors/flann_tree.h"

namespace tufted {
namespace {

/// Greatest number of rows in a leaf; one distance in many dimensions costs as much as passing several nodes.
constexpr int leaf_rows = 8;

class NearestRow : public flann::ResultSet<double> {
 public:
  bool full() const override { return true; }
  void addPoint(double squared, std::size_t index) override {
    if (squared < squared_) squared_ = squared, index_ = static_cast<int>(index);
  }
  double worstDist() const override { return squared_; }
  int index() const { return index_; }

 private:
  double squared_ = std::numeric_limits<double>::infinity();
  int index_ = 0;
};

}  // namespace

std::vector<int> nearestRows(const RowsOfNumbers& rows, const RowsOfNumbers& asked, const Workers& workers) {
  flann::KDTreeSingleIndex<flann::L2<double>> tree(
      flann::Matrix<double>(const_cast<double*>(rows.data()), static_cast<std::size_t>(rows.rows()),
                            static_cast<std::size_t>(rows.cols())),
      flann::KDTreeSingleIndexParams(leaf_rows));
  tree.buildIndex();
  const flann::SearchParams all_checks(flann::FLANN_CHECKS_UNLIMITED);
  std::vector<int> nearest(static_cast<std::size_t>(asked.rows()));
  workers.forBlocks("map", asked.rows(), costly_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t i = begin; i < end; ++i) {
      NearestRow found;
      tree.findNeighbors(found, asked.row(i).data(), all_checks);
      nearest[static_cast<std::size_t>(i)] = found.index();
    }
  });
  return nearest;
}

}  // namespace tufted
