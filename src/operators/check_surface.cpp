// Recomputes L and M from the cover (Sharp and Crane 2020, Algorithm 3) and compares them with those of a Laplacian.
#include "operators/check_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>

#include "base/cover_source.h"
#include "cover/clamped_weights.h"
#include "cover/face_scale.h"
#include "cover/geometry.h"
#include "operators/promise.h"

namespace tufted {
namespace {

using Eigen::Index;

constexpr double tolerance = 1e-11;  // relative to a diagonal or an area; all data sets agree within 6e-15
constexpr double smallest_area = std::numeric_limits<double>::min();

/// An edge of the cover that has no entry in L.
struct MissingEdge {
  int low, high;
  double weight;
};

/// Assembles weights and areas face by face (Sharp and Crane 2020, Algorithm 3, lines 6 to 15).
class Assembly {
 public:
  Assembly(const SparseMatrix& L, const IntrinsicTriangulation& cover, double scale)
      : L_(L), weight_(L.nonZeros()), area_(VectorXd::Zero(L.cols())), is_coarse_(L.cols()) {
    for (std::int64_t f = 0; f < cover.size(); ++f) add(cover.faces[f], unitFace(cover, f), scale);
    mergeOthers();
  }

  /// Calls visit(i, j, weight, L_ij) for every edge of the cover and every entry of L with i > j. The weight is 0 if
  /// only L has an entry.
  template <class Visit>
  void forEachEdge(const Visit& visit) const {
    for (int j = 0; j < L_.cols(); ++j) {
      for (int k = L_.outerIndexPtr()[j]; k < L_.outerIndexPtr()[j + 1]; ++k)
        if (L_.innerIndexPtr()[k] > j) visit(L_.innerIndexPtr()[k], j, weight_[k], L_.valuePtr()[k]);
    }
    for (const MissingEdge& edge : others_) visit(edge.high, edge.low, edge.weight, 0.0);
  }

  /// Areas of the points, in the points' unit squared.
  const VectorXd& area() const { return area_; }
  /// Whether a face at point i has lengths with fewer digits (UnitFace::isCoarse()); it is then not compared.
  bool isCoarse(Index i) const { return is_coarse_[i] != 0; }

 private:
  void add(const std::array<int, 3>& corner, const UnitFace& face, double scale) {
    const double area = face.area();
    for (const int c : corner) {
      if (face.isCoarse()) is_coarse_[c] = 1;
      area_[c] += scale * area / 3 * face.unit * face.unit;  // Section 3.3
    }
    for (int s = 0; s < 3; ++s) {
      const int a = corner[s], b = corner[(s + 1) % 3];
      const double cotan =
          cotanNumerator(face.length[s], face.length[(s + 1) % 3], face.length[(s + 2) % 3]) / (4 * area);
      if (a != b && std::isfinite(cotan)) addWeight(std::min(a, b), std::max(a, b), scale * cotan / 2);  // Section 3.3
    }
  }

  void addWeight(int low, int high, double weight) {
    const int* const rows = L_.innerIndexPtr();
    const int *begin = rows + L_.outerIndexPtr()[low], *end = rows + L_.outerIndexPtr()[low + 1];
    const int* const row = std::lower_bound(begin, end, high);
    if (row != end && *row == high)
      weight_[row - rows] += weight;
    else
      others_.push_back({low, high, weight});
  }

  void mergeOthers() {
    std::stable_sort(others_.begin(), others_.end(), [](const MissingEdge& a, const MissingEdge& b) {
      return std::tie(a.low, a.high) < std::tie(b.low, b.high);
    });
    std::size_t merged = 0;
    for (const MissingEdge& edge : others_) {
      if (merged > 0 && others_[merged - 1].low == edge.low && others_[merged - 1].high == edge.high)
        others_[merged - 1].weight += edge.weight;
      else
        others_[merged++] = edge;
    }
    others_.resize(merged);
  }

  const SparseMatrix& L_;
  std::vector<double> weight_;  ///< by entry of L, set below the diagonal
  std::vector<MissingEdge> others_;
  VectorXd area_;
  std::vector<std::uint8_t> is_coarse_;
};

void compareWeights(const SparseMatrix& L, const Assembly& assembly, SurfaceCheck& check,
                    std::vector<std::string>& faults) {
  Promise surface("surface");
  VectorXd diagonal = VectorXd::Zero(L.cols());
  assembly.forEachEdge([&](int i, int j, double weight, double) {
    diagonal[i] += std::max(weight, 0.0);
    diagonal[j] += std::max(weight, 0.0);
  });
  assembly.forEachEdge([&](int i, int j, double weight, double found) {
    if (assembly.isCoarse(i) || assembly.isCoarse(j)) return;
    const double larger = std::max(diagonal[i], diagonal[j]);
    if (weight < -weight_rounding * larger) surface.brokenBy("L(", i, ", ", j, ") = ", -weight, " by the cover");
    const double error = std::abs(found + std::max(weight, 0.0));
    if (error == 0) return;
    const double relative = larger > 0 ? error / larger : INFINITY;
    if (!(relative <= tolerance))
      surface.brokenBy("L(", i, ", ", j, ") = ", found, ", by the cover ", -std::max(weight, 0.0));
    raise(check.weight_error, relative);
  });
  surface.addTo(faults);
}

/// Compares the areas of all points with those expected.
/// @param expected areas of active points; those of others are 0
/// @returns the greatest relative error
double compareAreas(const char* name, const char* array, const Laplacian& laplacian, const Assembly& assembly,
                    const VectorXd& found, const VectorXd& expected, std::vector<std::string>& faults) {
  Promise area(name);
  double greatest = 0;
  for (Index i = 0; i < found.size(); ++i) {
    const double right = laplacian.status[i] == PointStatus::active ? expected[i] : 0;
    const double error = std::abs(found[i] - right);
    if (assembly.isCoarse(i) || error <= smallest_area) continue;
    if (!(error <= tolerance * right)) area.brokenBy(array, "(", i, ") = ", found[i], ", by the surface ", right);
    raise(greatest, right > 0 ? error / right : INFINITY);
  }
  area.addTo(faults);
  return greatest;
}

void compareMasses(const Laplacian& laplacian, const Assembly& assembly, SurfaceCheck& check,
                   std::vector<std::string>& faults) {
  const VectorXd& M = laplacian.M;
  VectorXd expected = assembly.area();
  check.masses_compared = true;
  if (laplacian.report.star_masses > 0) {
    const VectorXd own = laplacian.cover_source ? laplacian.cover_source->starAreas() : VectorXd();
    check.masses_compared = own.size() == M.size();
    if (check.masses_compared) {
      expected = (own.array() > 0).select(own, expected);
    } else {
      const auto& boundary = laplacian.boundary;
      const auto inside = std::count(boundary.begin(), boundary.end(), Boundary::none);
      // Files of earlier versions contain areas of stars at inner points as well.
      const bool is_old = laplacian.report.star_masses > M.size() - inside;
      for (Index i = 0; i < M.size(); ++i)
        if (is_old || boundary[static_cast<std::size_t>(i)] != Boundary::none) expected[i] = M[i];
    }
  }
  check.mass_error = compareAreas("mass", "M", laplacian, assembly, M, expected, faults);
}

}  // namespace

SurfaceCheck checkSurface(const Laplacian& laplacian, std::vector<std::string>& faults) {
  SurfaceCheck check;
  const Assembly assembly(laplacian.L, laplacian.cover(), faceScale(laplacian.kind));
  for (Index i = 0; i < laplacian.L.cols(); ++i) check.coarse_points += assembly.isCoarse(i) ? 1 : 0;
  compareWeights(laplacian.L, assembly, check, faults);
  if (laplacian.cover_areas.size() == laplacian.M.size()) {
    check.area_error =
        compareAreas("cover area", "cover_areas", laplacian, assembly, laplacian.cover_areas, assembly.area(), faults);
  }
  compareMasses(laplacian, assembly, check, faults);
  return check;
}

}  // namespace tufted
