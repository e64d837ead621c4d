#include "sample_laplacian.h"

#include <cstring>
#include <limits>

namespace {

template <class T>
tufted::Field field(const char* name, tufted::FieldType type, int count, const std::vector<T>& values) {
  tufted::Field result = {name, type, count, {}};
  result.bytes.resize(values.size() * sizeof(T));
  std::memcpy(result.bytes.data(), values.data(), result.bytes.size());
  return result;
}

}  // namespace

tufted::Geometry sampleGeometry() {
  tufted::Geometry geometry;
  const double x = 500000.1234567891, y = 5400000.9876543211;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  geometry.points.resize(4, 3);
  geometry.points << x, y, 0, x + 2, y, 0, x, y + 2, 0, nan, nan, nan;
  geometry.width = 4;
  geometry.is_mesh = true;
  geometry.triangles.resize(1, 3);
  geometry.triangles << 0, 1, 2;
  geometry.fields.push_back(field<float>("intensity", tufted::FieldType::float32, 1, {0.1f, 0.2f, 0.3f, 0.4f}));
  geometry.fields.push_back(field<std::uint32_t>("rgb", tufted::FieldType::uint32, 1, {0xff0a141e, 1, 2, 3}));
  geometry.fields.push_back(
      field<std::int16_t>("histogram", tufted::FieldType::int16, 2, {1, -2, 3, -4, 5, -6, 7, -8}));
  geometry.fields.push_back(field<std::int64_t>("time", tufted::FieldType::int64, 1, {1, 2, 3, 1ll << 40}));
  geometry.fields.push_back(field<float>("mass", tufted::FieldType::float32, 1, {9, 9, 9, 9}));
  return geometry;
}

tufted::Laplacian sampleLaplacian() {
  using Entry = Eigen::Triplet<double>;
  // Weights cot / 2: 1/2 on the legs (45 degrees opposite), 0 on the hypotenuse (a right angle).
  const std::vector<Entry> entries = {{0, 0, 1},   {1, 0, -0.5}, {2, 0, -0.5}, {0, 1, -0.5},
                                      {1, 1, 0.5}, {0, 2, -0.5}, {2, 2, 0.5}};
  tufted::Laplacian laplacian;
  laplacian.L.resize(4, 4);
  laplacian.L.setFromTriplets(entries.begin(), entries.end());
  laplacian.M = tufted::VectorXd::Constant(4, 2.0 / 3);
  laplacian.M(3) = 0;
  laplacian.status.assign(4, tufted::PointStatus::active);
  laplacian.status[3] = tufted::PointStatus::not_finite;
  laplacian.representative = {0, 1, 2, 3};
  using tufted::Boundary;
  laplacian.boundary = {Boundary::rim, Boundary::jump, Boundary::lost, Boundary::none};
  laplacian.report.points = 4;
  laplacian.report.active = 3;
  laplacian.report.not_finite = 1;
  laplacian.report.rim_points = laplacian.report.jump_points = laplacian.report.lost_points = 1;
  laplacian.report.triangles = 1;
  laplacian.report.nonzeros = 7;
  laplacian.report.votes = {1, 2, 3};
  laplacian.report.stages = {{"flips", 0.25, 1024}};
  return laplacian;
}
