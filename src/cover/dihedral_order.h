#pragma once

// The circular order of Algorithm 1 (Section 4.2; Section 5.4 compares it with others).
#include <Eigen/Geometry>
#include <span>
#include <utility>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "base/pseudo_angle.h"
#include "base/stable_sort.h"
#include "tufted/types.h"

namespace tufted {

/// The dihedral angle of faces around an edge, by which they are ordered circularly. The basis depends on the edge
/// only, so copies of a triangle have equal keys.
class DihedralOrder {
 public:
  DihedralOrder(const PointsView& points, int low, int high) : points_(points), low_(low) {
    const Eigen::Vector3d axis = points.row(high) - points.row(low);
    int smallest = 0;
    axis.cwiseAbs().minCoeff(&smallest);
    x_ = axis.cross(Eigen::Vector3d::Unit(smallest));
    y_ = axis.stableNormalized().cross(x_);
  }

  /// A number that increases with the angle of the face whose third corner is `apex`.
  double key(int apex) const {
    const Eigen::Vector3d d = points_.row(apex) - points_.row(low_);
    return pseudoAngle(d.dot(x_), d.dot(y_));
  }

 private:
  PointsView points_;
  int low_;
  Eigen::Vector3d x_, y_;
};

/// Sorts items by keys. Equal keys keep their order.
template <class Item>
class KeySort {
 public:
  /// @param key key(item): a number
  template <class Key>
  void sort(std::span<Item> items, const Key& key) {
    keyed_.clear();
    for (const Item& item : items) keyed_.emplace_back(static_cast<double>(key(item)), item);
    stableSort(keyed_.data(), keyed_.data() + keyed_.size(), scratch_,
               [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < items.size(); ++i) items[i] = keyed_[i].second;
  }

 private:
  Buffer<std::pair<double, Item>> keyed_, scratch_;
};

/// Sorts the faces around the edge (low, high) by their dihedral angle. Two have only one circular order.
/// @param apex apex(item): the third corner of the item's face
template <class Item, class Apex>
void sortAroundEdge(const PointsView& points, int low, int high, std::span<Item> items, const Apex& apex,
                    KeySort<Item>& key_sort) {
  if (items.size() <= 2) return;
  const DihedralOrder order(points, low, high);
  key_sort.sort(items, [&](const Item& item) { return order.key(apex(item)); });
}

}  // namespace tufted
