#pragma once

#include <cstdint>
#include <vector>

namespace tufted {

/// Candidates are looked at in groups of so many.
constexpr int selection_lane = 8;

/// Points by coordinate, filled up to a multiple of the lane with points that are nowhere near.
struct Candidates {
  std::vector<int> index;       ///< ranks
  std::vector<double> x, y, z;  ///< where they are
};

/// The two loops that choosing neighbours spends its time in. All implementations give the same bits.
struct SelectionKernels {
  /// The candidates within the squared distance `bound` of a point, but for number p: squared distances, with the bits
  /// of FLANN's L2_Simple, and ranks. Both arrays have room for all candidates and one lane.
  /// @returns how many
  int (*takeWithin)(const Candidates& candidates, const double* point, int p, double bound, double* squared_distance,
                    int* index);
  /// How many of the values are less than each.
  /// @param count a multiple of the lane
  void (*rankValues)(const double* values, int count, std::int64_t* rank);
};

/// Plain loops over pairs of doubles, which every processor has.
const SelectionKernels& portableKernels();

/// The fastest that this processor runs: AVX-512, or else the portable ones.
const SelectionKernels& fastestKernels();

}  // namespace tufted
