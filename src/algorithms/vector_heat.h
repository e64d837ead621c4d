#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/connected.h"
#include "algorithms/linear_system.h"
#include "tufted/vector_heat.h"

namespace tufted {

/// Fields on the points of a Laplacian that spread as heat.
struct HeatFields {
  Eigen::MatrixXd scalars;  ///< N x (1 + c); the first column is heat, >= 0, that the others are divided by
  Eigen::MatrixXd vectors;  ///< 2N x v, in the coordinates of the frames; v = 0: none
};

/// The heat equations of the vector heat method: M / t + L for scalars, and with the connection Laplacian for vectors.
/// Heat spreads in rounds, each of which continues the last where that becomes inaccurate, so fields reach any number
/// of edges.
class FieldHeat {
 public:
  /// @param function named in errors
  /// @param frames of the points; null: no vectors
  /// @param memory_limit bytes of all factors together
  /// @throws InvalidInput, SolverFailure, Cancelled
  FieldHeat(const char* function, const Laplacian& laplacian, const Frames* frames, const VectorHeatOptions& options,
            std::size_t memory_limit);

  /// Spreads fields from sources.
  /// @param function named in errors
  /// @returns scalars divided by the first column, and vectors of length 1; NaN where no heat arrives
  HeatFields spread(const char* function, const HeatFields& sources, VectorHeatReport& report,
                    const Progress& progress) const;

  /// The representative of a source; -1 if it is not active and ignored.
  /// @throws InvalidInput for an index out of range
  int place(const char* function, int source) const;
  /// Gives coincident points the rows of their representative.
  template <class Rows>
  void copyToCoincident(Rows& values) const {
    for (int i = 0; i < size(); ++i)
      if (representative_[i] != i) values.row(i) = values.row(representative_[i]);
  }

  /// Why a source is ignored, for errors.
  std::string whyIgnored(int source) const;

  int size() const { return static_cast<int>(representative_.size()); }
  /// The root mean squared distance of neighbours on the component of an active point.
  double spacingAt(int point) const { return spacing_[components_.of[point]]; }
  /// The time step on the component with the most points.
  double timeStep() const { return time_; }
  const SolverReport& report() const { return report_; }

 private:
  HeatFields solve(const char* function, HeatFields flow, const std::vector<std::uint8_t>& passed,
                   VectorHeatReport& report, const Progress& progress) const;
  /// Measures the backward error of a solve by factors ahead of the front, and sets heat behind it, which is rounding,
  /// to 0.
  void checkAhead(const char* function, const HeatFields& right, const std::vector<std::uint8_t>& passed,
                  HeatFields& heat, VectorHeatReport& report) const;
  /// The right side at the front for which the next round has the same heat ahead of it, and none behind.
  HeatFields flowAhead(const HeatFields& heat, const std::vector<std::uint8_t>& passed) const;

  SparseMatrix L_;
  VectorXd mass_;            ///< N; M / t, at least 1e-13 of the diagonal of L
  SparseMatrix connection_;  ///< 2N x 2N; empty without vectors
  Components components_;
  std::vector<int> representative_;
  std::vector<PointStatus> status_;
  VectorXd spacing_;  ///< by component; root mean squared distance of neighbours
  double time_ = 1;   ///< see timeStep()
  std::optional<LinearSystem> scalars_, vectors_;
  SolverReport report_;
};

}  // namespace tufted
