// Distances on clouds of mesh vertices against the exact ones along the mesh.
#include <Eigen/SparseCholesky>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "base/median.h"
#include "bench/compare/patches.h"
#include "bench/compare/solves.h"
#include "bench/compare/tables.h"
#include "oracles/geodesics.h"
#include "tufted/distance.h"

namespace tufted::bench {
namespace {

/// Shortest paths along the edges to the k nearest neighbours.
VectorXd dijkstra(const Points& points, int k, int source) {
  const NearestPoints nearest(points);
  std::vector<std::vector<int>> near(static_cast<std::size_t>(points.rows()));
  for (int p = 0; p < points.rows(); ++p) {
    for (const int q : patchOf(nearest, p, k).index) {
      near[static_cast<std::size_t>(p)].push_back(q);
      near[static_cast<std::size_t>(q)].push_back(p);
    }
  }
  VectorXd distance = VectorXd::Constant(points.rows(), std::numeric_limits<double>::infinity());
  std::priority_queue<std::pair<double, int>> front;
  front.emplace(distance[source] = 0, source);
  while (!front.empty()) {
    const auto [negative, p] = front.top();
    front.pop();
    if (-negative > distance[p]) continue;
    for (const int q : near[static_cast<std::size_t>(p)]) {
      const double through = distance[p] + (points.row(p) - points.row(q)).norm();
      if (through >= distance[q]) continue;
      distance[q] = through;
      front.emplace(-through, q);
    }
  }
  return distance;
}

/// The heat method (Crane et al. 2013) for any symmetric L: gradients by least squares in tangent planes, and the
/// function whose differences along the weights of L fit them best. Empty if L has no factor.
VectorXd heatDistances(const Points& points, const Operators& operators, int source) {
  const Eigen::Index n = points.rows();
  const double t = operators.M.mean();  // about the squared spacing, as the paper takes the squared edge length
  SparseMatrix heat = t * operators.L;
  for (Eigen::Index i = 0; i < n; ++i) heat.coeffRef(i, i) += operators.M[i] > 0 ? operators.M[i] : 1;
  const Eigen::SimplicialLDLT<SparseMatrix> factor(heat);
  if (factor.info() != Eigen::Success) return {};
  const VectorXd u = factor.solve(VectorXd::Unit(n, source));
  const NearestPoints nearest(points);
  Points direction(n, 3);
  for (int p = 0; p < n; ++p) {
    constexpr int fitted = 12;  // two rings
    const Patch patch = patchOf(nearest, p, fitted);
    Eigen::MatrixX3d offsets = points(patch.index, Eigen::all).rowwise() - points.row(p);
    const VectorXd steps = u(patch.index).array() - u[p];
    const Eigen::Vector3d gradient = Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixX3d>(offsets).solve(steps);
    const Eigen::RowVector3d normal = frameOf(points(patch.index, Eigen::all)).axes.col(2).transpose();
    direction.row(p) = -(gradient.transpose() - gradient.dot(normal) * normal).normalized();
  }
  VectorXd divergence = VectorXd::Zero(n);
  for (int q = 0; q < n; ++q)
    for (SparseMatrix::InnerIterator entry(operators.L, q); entry; ++entry)
      if (const auto p = entry.row(); p != q)
        divergence[p] -= entry.value() * (direction.row(p) + direction.row(q)).dot(points.row(p) - points.row(q)) / 2;
  const auto distance = solvePinned(operators.L, true, divergence, {{source}, Eigen::MatrixXd::Zero(1, 1)});
  return distance ? VectorXd(*distance) : VectorXd();
}

/// Mean |d - exact| over mean exact at the points that have a distance, one per shape, and the share of those without.
struct Errors {
  std::string method;
  Buffer<double> all{}, lost{};

  void add(const VectorXd& distance, const VectorXd& exact) {
    double sum = 0, exact_sum = 0, missing = 0;
    for (Eigen::Index i = 0; i < exact.size(); ++i) {
      if (distance.size() > 0 && std::isfinite(distance[i]))
        sum += std::abs(distance[i] - exact[i]), exact_sum += exact[i];
      else
        ++missing;
    }
    if (exact_sum > 0) all.push_back(sum / exact_sum);
    lost.push_back(missing / static_cast<double>(exact.size()));
  }
};

}  // namespace

Table printDistance(const Settings& settings) {
  constexpr Eigen::Index most = 25000;  // triangles: CGAL's exact search takes minutes on more
  std::vector<Errors> methods = {{"tufted, marching"}, {"tufted, heat"}};
  for (const int k : {8, 15, 30}) methods.push_back({"Dijkstra, " + std::to_string(k) + " nearest"});
  const std::size_t first = methods.size();
  std::vector<CloudRival> symmetric = rivalsOf(settings);
  std::erase_if(symmetric, [](const CloudRival& rival) { return !rival.symmetric; });
  for (const CloudRival& rival : symmetric) methods.push_back({"heat by " + rival.name});
  for (const RealShape& shape : shapesOf(settings, 0)) {
    if (shape.mesh.triangles.rows() > most) continue;
    const auto exact = oracles::exactDistances(shape.mesh.points, shape.mesh.triangles, 0, {1, 0, 0});
    if (!exact) continue;
    const Points& points = shape.mesh.points;
    const int source = shape.mesh.triangles(0, 0);
    const Laplacian laplacian = pointCloudLaplacian(points, {.threads = 1});
    methods[0].add(DistanceSolver(laplacian).query({source}), *exact);
    methods[1].add(DistanceSolver(laplacian, {.method = DistanceMethod::heat}).query({source}), *exact);
    for (const auto& [m, k] : {std::pair{2, 8}, {3, 15}, {4, 30}}) methods[m].add(dijkstra(points, k, source), *exact);
    for (std::size_t r = 0; r < symmetric.size(); ++r)
      methods[first + r].add(heatDistances(points, symmetric[r].build(points, symmetric[r].k), source), *exact);
  }
  Table table({"method", "shapes", "mean error: median", "worst", "points without distance: worst"});
  for (const auto& [name, all, lost] : methods) {
    table.row({name, static_cast<int>(all.size()), all.empty() ? Cell("") : percent(medianOf(all)),
               all.empty() ? Cell("") : percent(*std::max_element(all.begin(), all.end())),
               lost.empty() ? Cell("") : percent(*std::max_element(lost.begin(), lost.end()), "%.2f %%")});
  }
  return table;
}

}  // namespace tufted::bench
