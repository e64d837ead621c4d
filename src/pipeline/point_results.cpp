#include "pipeline/point_results.h"

#include <Eigen/Geometry>

#include "base/power_of_two.h"
#include "stars/tangent_frame.h"

namespace tufted {
void setBoundaryAndNormals(const Buffer<Boundary>& boundary, const PointsView& normals, const RankedCloud& cloud,
                           const Workers& workers, Laplacian& result) {
  const auto n = static_cast<Eigen::Index>(result.status.size());
  result.boundary.assign(result.status.size(), Boundary::none);
  result.frames.normals.resize(n, 3);
  workers.forBlocks("boundary", cloud.size(), usual_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t p = begin; p < end; ++p) {
      const int i = cloud.input_index[p];
      result.boundary[i] = boundary[p];
      result.frames.normals.row(i) = normals.row(p);
    }
  });
  for (Eigen::Index i = 0; i < n; ++i) {
    if (result.status[i] == PointStatus::coincident) {
      result.frames.normals.row(i) = result.frames.normals.row(result.representative[i]);
    } else if (result.status[i] == PointStatus::not_finite) {
      result.frames.normals.row(i).setZero();
    }
  }
}

void setPositions(const PointsRef& points, const RankedCloud& cloud, const Workers& workers, Laplacian& result) {
  result.positions.resize(points.rows(), 3);
  workers.forBlocks("boundary", points.rows(), usual_block, [&](std::int64_t begin, std::int64_t end, int) {
    result.positions.middleRows(begin, end - begin) = points.middleRows(begin, end - begin);
  });
  if (cloud.move.rows() == 0) return;
  const PowerOfTwo unit(cloud.exponent);
  workers.forBlocks("boundary", cloud.size(), usual_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t p = begin; p < end; ++p) {
      auto position = result.positions.row(cloud.input_index[p]);
      for (int axis = 0; axis < 3; ++axis) unit.addTo(position[axis], cloud.move.row(p)[axis]);
    }
  });
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    if (result.status[i] == PointStatus::coincident)
      result.positions.row(i) = result.positions.row(result.representative[i]);
}

void setNoise(const RawBuffer<double>& noise, const RankedCloud& cloud, Laplacian& result) {
  if (noise.empty()) {
    result.noise.resize(0);
    return;
  }
  const PowerOfTwo unit(cloud.exponent);
  result.noise.setZero(std::ssize(result.status));
  for (std::size_t p = 0; p < noise.size(); ++p) result.noise[cloud.input_index[p]] = unit.times(noise[p]);
  for (std::size_t i = 0; i < result.status.size(); ++i)
    if (result.status[i] == PointStatus::coincident) result.noise[i] = result.noise[result.representative[i]];
}

void faceViewpoint(const Eigen::Vector3d& viewpoint, const Workers& workers, Laplacian& result) {
  Points& normals = result.frames.normals;
  const Eigen::RowVector3d half = viewpoint.transpose() / 2;  // so that no difference overflows
  workers.forBlocks("boundary", normals.rows(), usual_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t i = begin; i < end; ++i)
      if (normals.row(i).dot(half - result.positions.row(i) / 2) < 0) normals.row(i) *= -1;
  });
  result.frames.orientation = Orientation::viewpoint;
}

void setTangents(const Workers& workers, Laplacian& result) {
  Frames& frames = result.frames;
  frames.tangents.resize(frames.normals.rows(), 3);
  workers.forBlocks("assemble", frames.normals.rows(), usual_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t i = begin; i < end; ++i) {
      const Eigen::Vector3d normal = frames.normals.row(i);
      frames.tangents.row(i) = normal.isZero(0) ? normal : tangentOf(normal);
    }
  });
}

void setOwnAreas(const RawBuffer<double>& own, const Buffer<int>& input_index, int exponent, Laplacian& result) {
  const PowerOfTwo area_unit(2 * exponent);
  for (std::size_t p = 0; p < own.size(); ++p) {
    const int i = input_index[p];
    if (result.status[i] != PointStatus::active || !(own[p] > 0)) continue;
    result.M[i] = area_unit.times(own[p]);
    ++result.report.star_masses;
  }
  if (result.report.star_masses > 0) result.report.area = result.M.sum();
}

}  // namespace tufted
