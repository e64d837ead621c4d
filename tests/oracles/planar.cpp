#include "oracles/planar.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <vector>

#include "oracles/oracles.h"
#include "shapes/random.h"

namespace tufted::oracles {

Triangles stretchedDelaunay(const Points& points, double stretch) {
  Points lifted = points;
  lifted.col(2) = points.col(0).array().square() + (stretch * points.col(1)).array().square();
  const Triangles hull = convexHullMesh(lifted);
  std::vector<int> kept;
  for (int f = 0; f < hull.rows(); ++f) {
    const Eigen::RowVector3d a = lifted.row(hull(f, 0));
    const Eigen::RowVector3d u = lifted.row(hull(f, 1)) - a, v = lifted.row(hull(f, 2)) - a;
    // Keeps lower faces. Vertical ones, with which the hull closes along a straight border, are dropped.
    const double area = u.x() * v.y() - u.y() * v.x();
    if (area < -1e-12) kept.push_back(f);
  }
  return hull(kept, Eigen::all);
}

PlanarMesh obtuseSquare(int inner, double stretch, std::uint64_t seed) {
  shapes::Random random(seed);
  PlanarMesh mesh;
  mesh.points = Points::Zero(inner + 4, 3);
  mesh.points.topRows(4) << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  for (int i = 4; i < inner + 4; ++i) {
    mesh.points(i, 0) = random.uniform(0.01, 0.99);
    mesh.points(i, 1) = random.uniform(0.01, 0.99);
  }
  mesh.triangles = stretchedDelaunay(mesh.points, stretch);
  return mesh;
}

ObtusePins pinsAtObtuseCorners(const PlanarMesh& mesh) {
  ObtusePins pins{{}, Eigen::MatrixXd(4, 1)};
  pins.values << 0, 1, 0, 1;
  const auto x = mesh.points.col(0).array(), y = mesh.points.col(1).array();
  const std::array<Eigen::ArrayXd, 4> from_side = {y, 1 - x, 1 - y, x};
  for (const Eigen::ArrayXd& distance : from_side) {
    Eigen::Index nearest = 0;
    distance.tail(distance.size() - 4).minCoeff(&nearest);
    pins.points.push_back(static_cast<int>(nearest) + 4);
  }
  return pins;
}

Book badBook(int pages, int n, double stretch, std::uint64_t seed) {
  shapes::Random random(seed);
  const int inner = n * n / 2, border = n + 1 + 2 * (n / 2);  // n + 1 points opposite the spine, n / 2 above and below
  Book book;
  const int total = n + 1 + pages * (inner + border);
  book.points = Points::Zero(total, 3);
  book.outward = VectorXd::Zero(total);
  book.page.assign(total, -1);
  for (int i = 0; i <= n; ++i) book.points(i, 2) = static_cast<double>(i) / n;
  std::vector<int> corners;
  int next = n + 1;
  for (int page = 0; page < pages; ++page) {
    std::vector<int> input_index(n + 1);
    for (int i = 0; i <= n; ++i) input_index[i] = i;
    const double angle = 2 * M_PI * page / pages;
    const auto add = [&](double outward, double height) {
      book.points.row(next) << outward * std::cos(angle), outward * std::sin(angle), height;
      book.outward[next] = outward;
      book.page[next] = page;
      input_index.push_back(next++);
    };
    for (int i = 0; i <= n; ++i) add(1, static_cast<double>(i) / n);
    for (int i = 1; i <= n / 2; ++i) {
      for (const double height : {0.0, 1.0}) add(2.0 * i / (n + 2), height);
    }
    for (int i = 0; i < inner; ++i) {
      const double outward = random.uniform(0.01, 0.99);
      add(outward, random.uniform(0.01, 0.99));
    }
    Points flat = Points::Zero(static_cast<Eigen::Index>(input_index.size()), 3);
    for (std::size_t k = 0; k < input_index.size(); ++k) {
      flat(static_cast<Eigen::Index>(k), 0) = book.outward[input_index[k]];
      flat(static_cast<Eigen::Index>(k), 1) = book.points(input_index[k], 2);
    }
    const Triangles triangles = stretchedDelaunay(flat, stretch);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
      for (int k = 0; k < 3; ++k) corners.push_back(input_index[triangles(f, k)]);
    }
  }
  book.triangles = Eigen::Map<Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3), 3);
  return book;
}

VectorXd bookDistances(const Book& book, int source) {
  VectorXd result(book.points.rows());
  for (Eigen::Index i = 0; i < result.size(); ++i) {
    const bool same = book.page[i] == book.page[source] || book.page[i] < 0 || book.page[source] < 0;
    const double across = same ? book.outward[i] - book.outward[source] : book.outward[i] + book.outward[source];
    result[i] = std::hypot(across, book.points(i, 2) - book.points(source, 2));
  }
  return result;
}

}  // namespace tufted::oracles
