// Isolines of fields on triangles.
#include "tufted/isolines.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>

#include "base/parallel.h"
#include "operators/corners_in_range.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr const char* isolines_name = "isolines";

/// An edge by its ends, the smaller one first.
struct Edge {
  int low, high;
  friend bool operator==(const Edge& a, const Edge& b) { return a.low == b.low && a.high == b.high; }
  friend bool operator<(const Edge& a, const Edge& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; }
};

Edge edgeBetween(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

/// Where the value lies between those of the ends of an edge, from 0 to 1.
double shareOf(double value, double low, double high) {
  const double rise = high - low;
  return std::isfinite(rise) ? (value - low) / rise : (value / 2 - low / 2) / (high / 2 - low / 2);
}

/// The lines of one value. Piece s of a line runs through one triangle, from end 2 s to end 2 s + 1, with larger values
/// on its left. Ends on the same edge are a node.
class LevelSet {
 public:
  LevelSet(const PointsRef& points, const Eigen::Ref<const VectorXd>& field, double value)
      : points_(points), field_(field), value_(value) {}

  void addPieces(const TrianglesRef& triangles, const std::vector<std::uint8_t>& is_usable) {
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
      if (is_usable[static_cast<std::size_t>(f)] == 0) continue;
      const auto corner = [&](int k) { return triangles(f, k % 3); };
      const auto is_above = [&](int k) { return field_[corner(k)] >= value_; };
      for (int k = 0; k < 3; ++k) {
        // The corner that lies alone on its side of the line.
        if (is_above(k) == is_above(k + 1) || is_above(k) == is_above(k + 2)) continue;
        ends_.push_back(edgeBetween(corner(k), corner(k + 1)));
        ends_.push_back(edgeBetween(corner(k), corner(k + 2)));
        if (!is_above(k)) std::swap(ends_[ends_.size() - 2], ends_.back());
      }
    }
  }

  /// Joins the pieces, first those of open lines, from their beginning if the triangles agree which that is.
  void addLines(std::vector<Polyline>& lines) {
    findMates();
    visited_.assign(ends_.size() / 2, 0);
    const int size = static_cast<int>(ends_.size());
    for (const int first : {0, 1})
      for (int end = first; end < size; end += 2)
        if (mate_[end] < 0) addLine(end, lines);
    for (int end = 0; end < size; end += 2) addLine(end, lines);
  }

 private:
  /// Finds for each end the other one on its edge; -1 if there is none or several.
  void findMates() {
    std::vector<int> order(ends_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return ends_[a] == ends_[b] ? a < b : ends_[a] < ends_[b]; });
    mate_.assign(ends_.size(), -1);
    for (std::size_t i = 0, next = 0; i < order.size(); i = next) {
      while (next < order.size() && ends_[order[next]] == ends_[order[i]]) ++next;
      if (next - i != 2) continue;
      mate_[order[i]] = order[i + 1];
      mate_[order[i + 1]] = order[i];
    }
  }

  Eigen::RowVector3d placeOf(const Edge& edge) const {
    const double share = shareOf(value_, field_[edge.low], field_[edge.high]);
    return (1 - share) * points_.row(edge.low) + share * points_.row(edge.high);
  }

  /// Adds the line that begins at an end, unless its pieces are already in one.
  void addLine(int begin, std::vector<Polyline>& lines) {
    if (visited_[begin / 2] != 0) return;
    std::vector<Eigen::RowVector3d> places = {placeOf(ends_[begin])};
    int end = begin;
    for (int next = begin; next >= 0 && visited_[next / 2] == 0; next = mate_[end]) {
      visited_[next / 2] = 1;
      end = next ^ 1;
      if (const auto place = placeOf(ends_[end]); place != places.back()) places.push_back(place);
    }
    Polyline line;
    line.is_closed = ends_[end] == ends_[begin];
    if (line.is_closed && places.size() > 1 && places.back() == places.front()) places.pop_back();
    if (places.size() < 2) return;
    line.value = value_;
    line.points = Eigen::Map<const Points>(places.front().data(), std::ssize(places), 3);
    for (std::size_t i = 1; i < places.size(); ++i) line.length += (places[i] - places[i - 1]).stableNorm();
    if (line.is_closed) line.length += (places.front() - places.back()).stableNorm();
    lines.push_back(std::move(line));
  }

  const PointsRef& points_;
  const Eigen::Ref<const VectorXd>& field_;
  double value_;
  std::vector<Edge> ends_;
  std::vector<int> mate_;
  std::vector<std::uint8_t> visited_;  ///< by piece
};

}  // namespace

std::vector<Polyline> isolines(const PointsRef& points, const TrianglesRef& triangles,
                               const Eigen::Ref<const VectorXd>& field, const std::vector<double>& values,
                               const Progress& progress) {
  if (field.size() != points.rows())
    throw InvalidInput(std::string(isolines_name) + ": field has " + std::to_string(field.size()) +
                       " values, must have " + std::to_string(points.rows()));
  requireCornersInRange(isolines_name, triangles, points.rows());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      throw InvalidInput(std::string(isolines_name) + ": value " + std::to_string(i) + " is not finite, must be");
  std::vector<std::uint8_t> is_usable(static_cast<std::size_t>(triangles.rows()));
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const int a = triangles(f, 0), b = triangles(f, 1), c = triangles(f, 2);
    const auto is_finite = [&](int i) { return std::isfinite(field[i]) && points.row(i).allFinite(); };
    is_usable[static_cast<std::size_t>(f)] = a != b && b != c && c != a && is_finite(a) && is_finite(b) && is_finite(c);
  }
  const Workers workers(1, progress);
  std::vector<Polyline> lines;
  for (std::size_t i = 0; i < values.size(); ++i) {
    workers.report("isolines", static_cast<double>(i) / static_cast<double>(values.size()));
    LevelSet level(points, field, values[i]);
    level.addPieces(triangles, is_usable);
    level.addLines(lines);
  }
  return lines;
}

}  // namespace tufted
