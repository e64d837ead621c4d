#include "algorithms/check_positions.h"

#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {

void checkPositions(const std::string& function, const Laplacian& laplacian) {
  checkSizes(function, laplacian);
  const auto n = std::ssize(laplacian.status);
  if (laplacian.positions.rows() != n)
    throw InvalidInput(function + ": Laplacian::positions has " + std::to_string(laplacian.positions.rows()) +
                       " rows, must have " + std::to_string(n) + ", one per point");
  for (Eigen::Index i = 0; i < n; ++i)
    if (laplacian.status[i] == PointStatus::active && !laplacian.positions.row(i).allFinite())
      throw InvalidInput(function + ": the position of point " + std::to_string(i) +
                         " is not finite, must be: the Laplacian has it active");
}

}  // namespace tufted
