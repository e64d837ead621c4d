#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <compare>
#include <cstdint>
#include <vector>

#include "io/number.h"
#include "io/steps.h"
#include "tufted/errors.h"
#include "tufted/io/select.h"

namespace tufted {
namespace {

using Triple = std::array<double, 3>;

/// Mixes the bits of three numbers (the finalizer of MurmurHash3 after each). 0 and -0 are the same.
std::uint64_t hashOf(const Triple& numbers) {
  std::uint64_t hash = 0;
  for (const double number : numbers) {
    hash ^= std::bit_cast<std::uint64_t>(number + 0.0);
    hash = (hash ^ hash >> 33) * 0xff51afd7ed558ccdULL;
    hash = (hash ^ hash >> 33) * 0xc4ceb9fe1a85ec53ULL;
    hash ^= hash >> 33;
  }
  return hash;
}

/// A point, and its place in the order of visits: the hash of its block, then that of its coordinates.
struct Visit {
  std::uint64_t block, hash;
  int point;

  auto operator<=>(const Visit&) const = default;
};

/// The chosen points, found by the cells of a grid.
class Chosen {
 public:
  Chosen(double spacing, std::size_t points) : spacing_(spacing), first_(std::bit_ceil(points + 1), -1) {}

  /// Chooses a point, and returns true, unless a chosen one is too close.
  bool visit(const Triple& at) {
    Triple cells[3];  // those of at - spacing, at and at + spacing along each axis
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k) cells[c][k] = std::floor((at[c] + (k - 1) * spacing_) / (2 * spacing_));
    // Rounding keeps the order of numbers, so one within the spacing lies in one of the three cells or between them.
    // Cells are twice as wide as the spacing, so nothing is between. The point's own cell comes first.
    for (const int i : {1, 0, 2})
      for (const int j : {1, 0, 2})
        for (const int k : {1, 0, 2}) {
          const bool is_repeated = (i != 1 && cells[0][i] == cells[0][1]) || (j != 1 && cells[1][j] == cells[1][1]) ||
                                   (k != 1 && cells[2][k] == cells[2][1]);
          if (!is_repeated && isTaken(at, {cells[0][i], cells[1][j], cells[2][k]})) return false;
        }
    int& first = first_[bucketOf({cells[0][1], cells[1][1], cells[2][1]})];
    chosen_.push_back({at, first});
    first = static_cast<int>(chosen_.size()) - 1;
    return true;
  }

 private:
  struct Entry {
    Triple at;
    int next;  ///< the entry of the same bucket before this one, -1: none
  };

  std::size_t bucketOf(const Triple& cell) const { return hashOf(cell) & (first_.size() - 1); }

  /// Whether a chosen point of this cell, or of one that shares its bucket, is too close.
  bool isTaken(const Triple& at, const Triple& cell) const {
    for (int entry = first_[bucketOf(cell)]; entry >= 0; entry = chosen_[entry].next) {
      const double x = chosen_[entry].at[0] - at[0], y = chosen_[entry].at[1] - at[1], z = chosen_[entry].at[2] - at[2];
      if (x * x + y * y + z * z < spacing_ * spacing_) return true;
    }
    return false;
  }

  double spacing_;
  std::vector<int> first_;  ///< the last entry of each bucket, -1: none
  std::vector<Entry> chosen_;
};

}  // namespace

std::vector<int> thinPoints(const Points& points, double spacing, const Progress& progress) {
  if (!(spacing >= 1e-150 && spacing <= 1e150))  // squares neither overflow nor underflow
    throw InvalidInput("thinPoints: spacing = " + io::shortestText(spacing) + ", must be in [1e-150, 1e150]");
  const auto at = [&](int i) { return Triple{points(i, 0), points(i, 1), points(i, 2)}; };
  // Blocks are visited one after the other, so that the buckets of a block stay in the processor's cache: 5 million
  // points take half the time.
  const double block_width = 64 * spacing;
  std::vector<Visit> visits;
  visits.reserve(static_cast<std::size_t>(points.rows()));
  for (int i = 0; i < points.rows(); ++i) {
    io::reportStep(progress, "sort points", static_cast<std::size_t>(i), visits.capacity());
    if (!points.row(i).allFinite()) continue;
    Triple block = at(i);
    for (double& number : block) number = std::floor(number / block_width);
    visits.push_back({hashOf(block), hashOf(at(i)), i});
  }
  std::sort(visits.begin(), visits.end());
  Chosen chosen(spacing, visits.size());
  std::vector<int> rows;
  for (std::size_t v = 0; v < visits.size(); ++v) {
    io::reportStep(progress, "thin", v, visits.size());
    if (chosen.visit(at(visits[v].point))) rows.push_back(visits[v].point);
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

}  // namespace tufted
