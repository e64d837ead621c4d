#pragma once

#include <array>
#include <vector>

#include "polygons/corner_tree.h"
#include "tufted/types.h"

namespace tufted {

/// Clips the ears of one polygon after another, each in the plane of its Newell normal.
///
/// The quality of a corner is the turn of its triangle over the sum of its squared edges, which is below 1/2; 1 is
/// subtracted if the turn is not positive or the triangle holds another corner. The next ear is the corner of the
/// greatest quality, the first one if several are equal. So the best shaped ear comes first and, if no ear is left
/// because the polygon is degenerate or crosses itself, the most convex corner: clipping always ends. Polygons of a
/// thousand corners and more are an exception: 1 is also subtracted from a quality up to 2^-40, as the corner is
/// straight. Where thousands of corners lie on one line but for rounding, such triangles reach along all of them, and
/// each corner would have to be tested.
///
/// Clipping adds nothing to a triangle, so one that is empty stays empty, and a corner whose triangle holds another
/// waits until that is clipped. On average it waits for 1 + ln n others, see CornerTree::firstIn(). So there are O(n
/// log n) searches. Most take O(log n) steps; those of long needles between thousands of scattered corners take
/// O(sqrt(n)).
class EarClipper {
 public:
  /// Starts a polygon of at least three corners; reuses memory.
  void begin(const Points& points, const std::vector<int>& polygon);

  /// The corners of the next triangle, as indices along the polygon. Called n - 2 times.
  std::array<int, 3> next();

 private:
  /// A corner of the polygon. Corners that wait for the same one form a list.
  struct Corner {
    int before, after;
    int holds = unknown;           ///< a corner in its triangle, for which this one waits, or `unknown` or `nothing`
    int first_waiting = none;      ///< first corner that waits for this one
    int last = none, next = none;  ///< neighbours in the list that this corner is in
  };
  /// No corner; not searched yet; searched, and nothing found.
  static constexpr int none = -1, unknown = -1, nothing = -2;

  int bestEar();
  void clip(int ear);
  /// The quality of a corner if no other lies in its triangle.
  double keyOfEmpty(int corner) const;
  /// Ends the waiting of a corner and resets what is known of it.
  void judge(int corner);
  void wait(int corner, int held);
  void stopWaiting(int corner);

  int winnerBelow(int node) const;
  void findWinner(int node);
  void setKey(int corner, double key);

  std::vector<Eigen::Vector2d> planar_;
  std::vector<Corner> corners_;
  CornerTree tree_;
  std::vector<double> key_;   ///< upper bound on the quality of each corner
  std::vector<int> winner_;   ///< the best corner below node i of a binary tree, whose children are 2 i and 2 i + 1
  int first_ = 0, left_ = 0;  ///< the first remaining corner, and the number of these
};

}  // namespace tufted
