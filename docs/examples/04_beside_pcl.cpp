// 04_beside_pcl FILE [STRIDE] [EIGENPAIRS]: the processor time of each class beside that of PCL's on an organized PCD
// file, on one thread, and the errors of both on a sphere and a torus. Every STRIDE-th row and column is used (1).
#include <pcl/common/io.h>
#include <pcl/console/print.h>
#include <pcl/features/boundary.h>
#include <pcl/features/fpfh.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/features/principal_curvatures.h>
#include <pcl/io/pcd_io.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/conditional_euclidean_clustering.h>
#include <pcl/surface/gp3.h>
#include <pcl/surface/mls.h>
#include <tufted/pcl/geodesic_distance.h>
#include <tufted/pcl/laplacian_estimation.h>
#include <tufted/pcl/laplacian_smoothing.h>
#include <tufted/pcl/oriented_normal_estimation.h>
#include <tufted/pcl/principal_curvature_estimation.h>
#include <tufted/pcl/spectral_signature_estimation.h>
#include <tufted/pcl/surface_boundary_estimation.h>
#include <tufted/pcl/surface_denoising.h>
#include <tufted/pcl/surface_segmentation.h>
#include <tufted/pcl/surface_triangulation.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

namespace {

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
constexpr int k = 30;  // the default of the options of tufted

/// Prints the microseconds of processor time per point of a call, the lesser of two times unless it takes seconds. On
/// one thread that is the time on a machine which does nothing else.
template <class Call>
void measure(const char* name, double points, const Call& call) {
  double least = INFINITY;
  for (int run = 0; run < 2 && (run == 0 || least < 5); ++run) {
    const std::clock_t start = std::clock();
    call();
    least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::printf("  %-52s %8.2f\n", name, 1e6 * least / points);
}

Cloud::Ptr thinned(const Cloud& cloud, std::uint32_t stride) {
  Cloud::Ptr thin(new Cloud(cloud.width / stride, cloud.height / stride));
  for (std::uint32_t row = 0; row < thin->height; ++row)
    for (std::uint32_t column = 0; column < thin->width; ++column)
      thin->at(column, row) = cloud.at(column * stride, row * stride);
  thin->is_dense = false;
  thin->sensor_origin_ = cloud.sensor_origin_;
  return thin;
}

void times(const Cloud::Ptr& cloud, int eigenpairs) {
  // Some classes of PCL take no NaN.
  const Cloud::Ptr finite(new Cloud);
  for (const Point& point : *cloud)
    if (pcl::isFinite(point)) finite->push_back(point);
  const auto n = static_cast<double>(finite->size());
  std::printf("%u x %u pixels, %.0f points; microseconds per point, one thread\n\n", cloud->width, cloud->height, n);

  tufted::LaplacianEstimation<Point> estimation;
  estimation.setInputCloud(cloud);
  estimation.setNumberOfThreads(1);
  std::shared_ptr<const tufted::Laplacian> surface = estimation.compute();
  measure("LaplacianEstimation, which the next ones share", n, [&] { surface = estimation.compute(); });
  const auto share = [&](auto& object) {
    object.setInputCloud(cloud);
    object.setSurface(surface);
    object.setNumberOfThreads(1);
  };
  const auto measured = [&](const char* name, auto& feature) {
    share(feature);
    typename std::decay_t<decltype(feature)>::PointCloudOut output;
    measure(name, n, [&] { feature.compute(output); });
  };
  tufted::OrientedNormalEstimation<Point> normals;
  normals.setComputeCurvature(false);
  measured("OrientedNormalEstimation without curvature", normals);
  tufted::OrientedNormalEstimation<Point> both;
  measured("OrientedNormalEstimation with mean curvature", both);
  tufted::PrincipalCurvatureEstimation<Point> principal;
  measured("PrincipalCurvatureEstimation", principal);
  tufted::SurfaceBoundaryEstimation<Point> boundary;
  measured("SurfaceBoundaryEstimation", boundary);
  tufted::SpectralSignatureEstimation<Point> signature;
  signature.setEigenpairs(eigenpairs);
  measured("SpectralSignatureEstimation", signature);

  tufted::SurfaceSegmentation<Point> segmentation;
  share(segmentation);
  std::vector<pcl::PointIndices> segments;
  measure("SurfaceSegmentation, components", n, [&] { segmentation.segment(segments); });
  tufted::GeodesicDistance<Point> distance;
  share(distance);
  distance.setSources({segments.at(0).indices.at(0)});
  pcl::PointCloud<pcl::PointXYZI> distances;
  measure("GeodesicDistance, a query to all points", n, [&] { distance.compute(distances); });
  tufted::SurfaceTriangulation<Point> triangulation;
  share(triangulation);
  pcl::PolygonMesh mesh;
  measure("SurfaceTriangulation", n, [&] { triangulation.reconstruct(mesh); });
  tufted::LaplacianSmoothing<Point> smoothing;
  share(smoothing);
  Cloud moved;
  measure("LaplacianSmoothing", n, [&] { smoothing.filter(moved); });
  tufted::SurfaceDenoising<Point> denoising;
  denoising.setInputCloud(cloud);
  denoising.setNumberOfThreads(1);
  measure("SurfaceDenoising, without the Laplacian", n, [&] { denoising.filter(moved); });

  std::printf("\n");
  const pcl::search::KdTree<Point>::Ptr tree(new pcl::search::KdTree<Point>);
  const pcl::PointCloud<pcl::Normal>::Ptr pcl_normals(new pcl::PointCloud<pcl::Normal>);
  measure("pcl::NormalEstimationOMP", n, [&] {
    pcl::NormalEstimationOMP<Point, pcl::Normal> feature(1);
    feature.setInputCloud(finite);
    feature.setSearchMethod(tree);
    feature.setKSearch(k);
    feature.compute(*pcl_normals);
  });
  const auto ofNormals = [&](const char* name, auto feature, auto output) {
    feature.setInputCloud(finite);
    feature.setInputNormals(pcl_normals);
    feature.setSearchMethod(tree);
    feature.setKSearch(k);
    measure(name, n, [&] { feature.compute(output); });
  };
  ofNormals("pcl::PrincipalCurvaturesEstimation",
            pcl::PrincipalCurvaturesEstimation<Point, pcl::Normal, pcl::PrincipalCurvatures>(),
            pcl::PointCloud<pcl::PrincipalCurvatures>());
  ofNormals("pcl::BoundaryEstimation", pcl::BoundaryEstimation<Point, pcl::Normal, pcl::Boundary>(),
            pcl::PointCloud<pcl::Boundary>());
  ofNormals("pcl::FPFHEstimation", pcl::FPFHEstimation<Point, pcl::Normal, pcl::FPFHSignature33>(),
            pcl::PointCloud<pcl::FPFHSignature33>());

  // The radius that PCL needs where k would not do: in the median it holds k points.
  std::vector<float> radii;
  pcl::Indices found;
  std::vector<float> squares;
  for (std::size_t i = 0; i < finite->size(); i += 37) {
    tree->nearestKSearch((*finite)[i], k, found, squares);
    radii.push_back(std::sqrt(squares.back()));
  }
  std::nth_element(radii.begin(), radii.begin() + static_cast<long>(radii.size()) / 2, radii.end());
  const float radius = radii[radii.size() / 2];
  measure("pcl::ConditionalEuclideanClustering", n, [&] {
    pcl::ConditionalEuclideanClustering<Point> clustering;
    clustering.setInputCloud(finite);
    clustering.setClusterTolerance(radius);
    const std::function<bool(const Point&, const Point&, float)> always = [](auto&, auto&, float) { return true; };
    clustering.setConditionFunction(always);
    pcl::IndicesClusters clusters;
    clustering.segment(clusters);
  });
  const pcl::PointCloud<pcl::PointNormal>::Ptr with_normals(new pcl::PointCloud<pcl::PointNormal>);
  pcl::concatenateFields(*finite, *pcl_normals, *with_normals);
  measure("pcl::GreedyProjectionTriangulation", n, [&] {
    pcl::GreedyProjectionTriangulation<pcl::PointNormal> greedy;
    greedy.setInputCloud(with_normals);
    greedy.setSearchMethod(pcl::search::KdTree<pcl::PointNormal>::Ptr(new pcl::search::KdTree<pcl::PointNormal>));
    greedy.setSearchRadius(radius);
    greedy.setMu(2.5);
    greedy.setMaximumNearestNeighbors(100);
    pcl::PolygonMesh greedy_mesh;
    greedy.reconstruct(greedy_mesh);
  });
  measure("pcl::MovingLeastSquares", n, [&] {
    pcl::MovingLeastSquares<Point, pcl::PointNormal> squares_fit;
    squares_fit.setInputCloud(finite);
    squares_fit.setSearchMethod(tree);
    squares_fit.setSearchRadius(radius);
    squares_fit.setPolynomialOrder(2);
    squares_fit.setComputeNormals(true);
    pcl::PointCloud<pcl::PointNormal> projected;
    squares_fit.process(projected);
  });
}

/// A shape with its outward normals and principal curvatures.
struct Shape {
  const char* name;
  Cloud::Ptr cloud{new Cloud};
  std::vector<Eigen::Vector3d> normals = {};
  std::vector<std::array<double, 2>> curvatures = {};

  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, double first, double second) {
    cloud->push_back({static_cast<float>(point.x()), static_cast<float>(point.y()), static_cast<float>(point.z())});
    normals.push_back(normal);
    curvatures.push_back({std::max(first, second), std::min(first, second)});
  }
};

/// A number in [0, 1), the same with every standard library.
double next(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// Random points, uniform per area; noise along the normal.
Shape sphere(int n, double noise) {
  std::mt19937_64 random(101);
  Shape shape{"sphere"};
  for (int i = 0; i < n; ++i) {
    const double z = 2 * next(random) - 1, turn = 2 * std::numbers::pi * next(random), r = std::sqrt(1 - z * z);
    const Eigen::Vector3d normal(r * std::cos(turn), r * std::sin(turn), z);
    const double offset = noise * (next(random) + next(random) + next(random) + next(random) - 2) * std::sqrt(3.0);
    shape.add((1 + offset) * normal, normal, 1, 1);
  }
  return shape;
}

/// Radii 1 and 0.4.
Shape torus(int n, double noise) {
  std::mt19937_64 random(101);
  Shape shape{"torus"};
  while (static_cast<int>(shape.normals.size()) < n) {
    const double u = 2 * std::numbers::pi * next(random), v = 2 * std::numbers::pi * next(random);
    if (1.4 * next(random) > 1 + 0.4 * std::cos(v)) continue;  // the area there is less
    const Eigen::Vector3d normal(std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v));
    const double offset = noise * (next(random) + next(random) + next(random) + next(random) - 2) * std::sqrt(3.0);
    const Eigen::Vector3d centre(std::cos(u), std::sin(u), 0);
    shape.add(centre + (0.4 + offset) * normal, normal, 1 / 0.4, std::cos(v) / (1 + 0.4 * std::cos(v)));
  }
  return shape;
}

double degreesBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * 180 / std::numbers::pi;
}

/// Prints the errors of one way. PCL's principal curvatures are sizes without a unit, so they are compared with
/// absolute values, the larger one first, after multiplication by the one factor that suits them best.
void errors(const Shape& shape, double noise, bool is_pcl, const pcl::PointCloud<pcl::Normal>& normals,
            const pcl::PointCloud<pcl::PrincipalCurvatures>& curvatures) {
  const auto n = static_cast<Eigen::Index>(shape.normals.size());
  Eigen::ArrayX2d found(n, 2), truth(n, 2);
  double angle = 0, inwards = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double degrees = degreesBetween(normals[i].getNormalVector3fMap().cast<double>(), shape.normals[i]);
    angle += std::min(degrees, 180 - degrees);
    inwards += degrees > 90 ? 1 : 0;
    found.row(i) << curvatures[i].pc1, curvatures[i].pc2;
    truth.row(i) << shape.curvatures[i][0], shape.curvatures[i][1];
    if (!is_pcl) continue;
    truth.row(i) = truth.row(i).abs().eval();
    if (truth(i, 0) < truth(i, 1)) std::swap(truth(i, 0), truth(i, 1));
  }
  if (is_pcl) found *= (found * truth).sum() / found.square().sum();
  const Eigen::Array2d off = 100 * (found - truth).abs().colwise().mean().transpose() / truth.abs().maxCoeff();
  const double other_sign = 100 * std::min(inwards, static_cast<double>(n) - inwards) / static_cast<double>(n);
  std::printf("  %-7s %5.3f  %-7s %9.2f %12.1f %9.1f %9.1f\n", shape.name, noise, is_pcl ? "pcl" : "tufted",
              angle / static_cast<double>(n), other_sign, off[0], off[1]);
}

void compareErrors(const Shape& shape, double noise) {
  pcl::PointCloud<pcl::Normal> normals;
  pcl::PointCloud<pcl::PrincipalCurvatures> curvatures;
  tufted::OrientedNormalEstimation<Point> ours;
  ours.setInputCloud(shape.cloud);
  ours.compute(normals);
  tufted::PrincipalCurvatureEstimation<Point> principal;
  principal.setInputCloud(shape.cloud);
  principal.setSurface(ours.getSurface());
  principal.compute(curvatures);
  errors(shape, noise, false, normals, curvatures);

  const pcl::search::KdTree<Point>::Ptr tree(new pcl::search::KdTree<Point>);
  const pcl::PointCloud<pcl::Normal>::Ptr pcl_normals(new pcl::PointCloud<pcl::Normal>);
  pcl::NormalEstimationOMP<Point, pcl::Normal> theirs(1);
  theirs.setInputCloud(shape.cloud);
  theirs.setSearchMethod(tree);
  theirs.setKSearch(k);
  theirs.compute(*pcl_normals);
  pcl::PrincipalCurvaturesEstimation<Point, pcl::Normal, pcl::PrincipalCurvatures> their_curvatures;
  their_curvatures.setInputCloud(shape.cloud);
  their_curvatures.setInputNormals(pcl_normals);
  their_curvatures.setSearchMethod(tree);
  their_curvatures.setKSearch(k);
  their_curvatures.compute(curvatures);
  errors(shape, noise, true, *pcl_normals, curvatures);
}

}  // namespace

int main(int argc, char** argv) {
  Cloud cloud;
  if (argc < 2) {
    std::fprintf(stderr, "usage: 04_beside_pcl FILE [STRIDE] [EIGENPAIRS]\n");
    return 2;
  }
  if (pcl::io::loadPCDFile(argv[1], cloud) != 0) return 1;
  if (cloud.height < 2) {
    std::fprintf(stderr, "%s is not organized, must be\n", argv[1]);
    return 1;
  }
  pcl::console::setVerbosityLevel(pcl::console::L_ERROR);
  times(thinned(cloud, argc > 2 ? static_cast<std::uint32_t>(std::max(1, std::atoi(argv[2]))) : 1),
        argc > 3 ? std::atoi(argv[3]) : 100);
  std::printf(
      "\nMean errors at 5000 points: normals in degrees up to their sign, share of normals with the sign of the fewer "
      "in\n"
      "%%, principal curvatures in %% of the greatest one (PCL's have no unit: times the factor that suits them "
      "best)\n\n"
      "  shape   noise  way       normals   other sign       pc1       pc2\n");
  for (const double noise : {0.0, 0.01}) {
    compareErrors(sphere(5000, noise), noise);
    compareErrors(torus(5000, noise), noise);
  }
}
