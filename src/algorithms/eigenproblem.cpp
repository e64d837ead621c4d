#include "algorithms/eigenproblem.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "operators/lower_triangle.h"

namespace tufted {

using Eigen::Index;
using Eigen::MatrixXd;

Eigenproblem::Eigenproblem(const Laplacian& laplacian) : L(laplacian.L), components(findComponents(laplacian)) {
  mass = VectorXd::Zero(laplacian.M.size());
  const double largest = std::max(laplacian.M.size() > 0 ? laplacian.M.maxCoeff() : 0.0, 0.0);
  for (const int i : components.points) mass[i] = largest > 0 ? laplacian.M[i] / largest : 0;
  total = mass.sum();
  if (total > 0) mass /= total;
  total *= largest;
  area = components.sums(mass);
  for (int c = 0; c < components.count; ++c)
    if (area[c] > 0) order.push_back(c);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return area[a] > area[b]; });
  usable = (mass.array() > 0).count();
  for (const int i : components.points)
    if (!(mass[i] > 0) && area[components.of[i]] > 0) massless.push_back(i);
}

MatrixXd Eigenproblem::constants(Index count) const {
  MatrixXd result = MatrixXd::Zero(mass.size(), count);
  std::vector<Index> column(components.count, count);
  for (Index c = 0; c < count; ++c) column[order[c]] = c;
  for (const int i : components.points) {
    const int component = components.of[i];
    if (column[component] < count) result(i, column[component]) = 1 / std::sqrt(area[component]);
  }
  return result;
}

void Eigenproblem::deflate(Eigen::Ref<MatrixXd> x) const {
  for (Index c = 0; c < x.cols(); ++c) {
    const VectorXd sums = components.sums(x.col(c).cwiseProduct(mass));
    for (const int i : components.points) {
      const int component = components.of[i];
      if (area[component] > 0) x(i, c) -= sums[component] / area[component];
    }
  }
}

void Eigenproblem::fillMassless(Eigen::Ref<MatrixXd> x) const {
  if (massless.empty()) return;
  NumberedPoints selection(static_cast<std::size_t>(L.cols()));
  for (const int i : massless) selection.add(i);
  const Eigen::SimplicialLDLT<LongMatrix> factor(
      lowerTriangle(L, selection, [](int, int, double value) { return value; }));
  for (const int i : massless) x.row(i).setZero();
  const MatrixXd right = -MatrixXd(L * x)(massless, Eigen::all);
  const MatrixXd solution = factor.solve(right);  // Eigen cannot solve into selected rows
  x(massless, Eigen::all) = solution;
}

}  // namespace tufted
