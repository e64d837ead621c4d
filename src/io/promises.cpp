#include "io/promises.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "io/errors.h"
#include "io/number.h"
#include "io/result_arrays.h"

namespace tufted::io {
namespace {

bool isActive(const Laplacian& laplacian, Eigen::Index i) {
  return laplacian.status[i] == PointStatus::active;
}

class MatrixCheck {
 public:
  MatrixCheck(std::filesystem::path path, const Laplacian& laplacian)
      : path_(std::move(path)),
        laplacian_(laplacian),
        start_(laplacian.L.outerIndexPtr()),
        row_(laplacian.L.innerIndexPtr()),
        value_(laplacian.L.valuePtr()),
        above_(start_, start_ + laplacian.L.cols()) {}

  void run() {
    for (int j = 0; j < static_cast<int>(laplacian_.L.cols()); ++j) {
      passAbove(j, j);  // entries still not compared have no partner below the diagonal
      checkColumn(j);
    }
  }

 private:
  [[noreturn]] void refuseEntry(int i, int j, double value, const std::string& rule) const {
    refuse(path_, entry(i, j, value) + ", must " + rule);
  }
  static std::string entry(int i, int j, double value) {
    return "L(" + std::to_string(i) + ", " + std::to_string(j) + ") = " + shortestText(value);
  }

  void checkColumn(int j) {
    double diagonal = 0, off_diagonal = 0;
    for (int k = start_[j]; k < start_[j + 1]; ++k) {
      const int i = row_[k];
      const double value = value_[k];
      if (!std::isfinite(value)) refuseEntry(i, j, value, "be finite");
      for (const int point : {i, j})
        if (value != 0 && !isActive(laplacian_, point))
          refuseEntry(i, j, value, "be 0: by status.npy point " + std::to_string(point) + " is not active");
      (i == j ? diagonal : off_diagonal) += value;
      if (i == j) continue;
      if (value > 0) refuseEntry(i, j, value, "not be above 0 off the diagonal");
      if (i > j) compare(i, j, value, takeAbove(j, i));
    }
    if (!isActive(laplacian_, j)) return;
    if (!(diagonal > 0))
      refuseEntry(j, j, diagonal, "be above 0: by status.npy point " + std::to_string(j) + " is active");
    // The diagonal is minus the sum of the others, whose terms have one sign, up to the order of summation.
    const double rounding = (start_[j + 1] - start_[j]) * std::numeric_limits<double>::epsilon();
    const double sum = off_diagonal + diagonal;
    if (!(std::abs(sum) <= rounding * diagonal))
      refuse(path_, "row " + std::to_string(j) + " sums to " + shortestText(sum) + " beside " + entry(j, j, diagonal) +
                        ", must sum to 0 within rounding");
  }

  /// Refuses L(i, j) = below unless L(j, i) = above is the same; 0: not stored.
  void compare(int i, int j, double below, double above) const {
    if (below != above) refuse(path_, entry(i, j, below) + ", " + entry(j, i, above) + ", must be equal");
  }

  /// The entry in row i of column j, above the diagonal; 0 if not stored. To be called with ascending i for each j.
  double takeAbove(int i, int j) {
    passAbove(i, j);
    const int k = above_[j];
    if (k == start_[j + 1] || row_[k] != i) return 0;
    ++above_[j];
    return value_[k];
  }

  /// Advances to row i of column j. Entries that are skipped have no partner below the diagonal, so they must be 0.
  void passAbove(int i, int j) {
    for (int& k = above_[j]; k < start_[j + 1] && row_[k] < i; ++k) compare(j, row_[k], 0, value_[k]);
  }

  std::filesystem::path path_;
  const Laplacian& laplacian_;
  const int* start_;
  const int* row_;
  const double* value_;
  std::vector<int> above_;  ///< for each column the first entry above the diagonal that is not yet compared
};

void checkMasses(const std::filesystem::path& path, const Laplacian& laplacian) {
  for (Eigen::Index i = 0; i < laplacian.M.size(); ++i) {
    const double mass = laplacian.M[i];
    const bool active = isActive(laplacian, i);
    if (std::isfinite(mass) && (active ? mass >= 0 : mass == 0)) continue;
    refuse(path, "M(" + std::to_string(i) + ") = " + shortestText(mass) + ", must be " +
                     (active ? "finite and at least 0" : "0: by status.npy the point is not active"));
  }
}

void checkPoints(const std::filesystem::path& dir, const Laplacian& laplacian) {
  const std::vector<int>& representative = laplacian.representative;
  for (int i = 0; i < static_cast<int>(std::ssize(laplacian.status)); ++i) {
    const int same = representative[i];
    const bool coincident = laplacian.status[i] == PointStatus::coincident;
    if (coincident ? !(same < i && representative[same] == same) : same != i)
      refuse(dir / "representative.npy",
             "point " + std::to_string(i) + " names " + std::to_string(same) + ", must name " +
                 (coincident ? "an earlier one that names itself: by status.npy it is coincident"
                             : "itself: by status.npy it is not coincident"));
    if (laplacian.boundary[i] != Boundary::none && !coincident && !isActive(laplacian, i))
      refuse(dir / "boundary.npy", "point " + std::to_string(i) + " has " +
                                       std::to_string(static_cast<int>(laplacian.boundary[i])) +
                                       ", must have 0: by status.npy it is not active");
  }
}

}  // namespace

void requirePromises(const std::filesystem::path& dir, const Laplacian& laplacian) {
  MatrixCheck(dir / "L.npz", laplacian).run();
  checkMasses(dir / "M.npy", laplacian);
  checkPoints(dir, laplacian);
  requireOrthonormal(dir / "frames.npy", laplacian.frames, laplacian.status);
  requireFinite(dir / positions_name, laplacian.positions, laplacian.status);
}

}  // namespace tufted::io
