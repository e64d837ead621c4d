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

/// Fields on the points of a Laplacian, by which heat spreads.
struct HeatFields {
  Eigen::MatrixXd scalars;  ///< N x (1 + c); the first column is the heat that others are compared with, >= 0
  Eigen::MatrixXd vectors;  ///< 2N x v, in the coordinates of the frames; v = 0: none
};

/// The heat equations of the vector heat method, M / t + L for scalars and with the connection for vectors. Heat that
/// becomes too small to be accurate is started again from where it still is (as in HeatRounds), so fields reach any
/// number of edges far.
class FieldHeat {
 public:
  /// @param function the constructor to name in errors
  /// @param frames of the points; null: there are no vectors
  /// @param memory_limit bytes that all factors together may take
  /// @throws InvalidInput, SolverFailure, Cancelled
  FieldHeat(const char* function, const Laplacian& laplacian, const Frames* frames, const VectorHeatOptions& options,
            std::size_t memory_limit);

  /// Spreads what flows in at sources.
  /// @param function the query to name in errors
  /// @returns scalars over the first column, and vectors of length 1; NaN where nothing comes
  HeatFields spread(const char* function, const HeatFields& sources, VectorHeatReport& report,
                    const Progress& progress) const;

  /// The place of a source: an active point, or -1 where it is to be ignored.
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
  /// The time step on the component that has the most points.
  double timeStep() const { return time_; }
  const SolverReport& report() const { return report_; }

 private:
  HeatFields solve(const char* function, HeatFields flow, const std::vector<std::uint8_t>& passed,
                   VectorHeatReport& report, const Progress& progress) const;
  /// Measures what a solve by factors leaves over ahead of the front, and takes out the rounding behind it.
  void checkAhead(const char* function, const HeatFields& right, const std::vector<std::uint8_t>& passed,
                  HeatFields& heat, VectorHeatReport& report) const;
  /// What flows in at the front, so that the next round has the same heat ahead of it, and none behind.
  HeatFields flowAhead(const HeatFields& heat, const std::vector<std::uint8_t>& passed) const;

  SparseMatrix L_;
  VectorXd mass_;            ///< N; M / t, but never lost beside L
  SparseMatrix connection_;  ///< 2N x 2N; empty without vectors
  Components components_;
  std::vector<int> representative_;
  std::vector<PointStatus> status_;
  VectorXd spacing_;  ///< by component, the root mean squared distance of neighbours
  double time_ = 1;   ///< of the component that has the most points
  std::optional<LinearSystem> scalars_, vectors_;
  SolverReport report_;
};

}  // namespace tufted
