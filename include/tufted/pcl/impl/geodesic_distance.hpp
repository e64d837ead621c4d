#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tufted/pcl/geodesic_distance.h"
#include "tufted/pcl/impl/cloud_laplacian.hpp"

template <typename PointT>
bool tufted::GeodesicDistance<PointT>::run(const char* method, const std::function<void(const Laplacian&)>& use) {
  if (!this->initCompute()) return false;
  const bool succeeded = detail::reported(getClassName(), method, [&] {
    use(this->surfaceOf(getClassName(),
                        detail::wholeInput<PointT>(input_, *indices_, this->hasGivenSurface() ? nullptr : search_,
                                                   this->getKSearch())));
  });
  this->deinitCompute();
  return succeeded;
}

template <typename PointT>
void tufted::GeodesicDistance<PointT>::compute(pcl::PointCloud<pcl::PointXYZI>& output) {
  pcl::PointCloud<pcl::PointXYZI> result;
  run("compute", [&](const Laplacian& laplacian) {
    const int threads = this->getOptions().threads;
    if (!solver_ || prepared_ != this->getSurface() || prepared_threads_ != threads) {
      solver_.reset();
      solver_ = std::make_shared<const DistanceSolver>(laplacian, DistanceOptions{.solver = {.threads = threads}});
      prepared_ = this->getSurface();
      prepared_threads_ = threads;
    }
    const std::shared_ptr<const DistanceSolver> solver = solver_;
    // A Laplacian of our own is never the same again, and its memory is for the next one.
    if (!this->hasGivenSurface()) {
      prepared_.reset();
      solver_.reset();
    }
    const VectorXd distance = solver->query(sources_);

    result.header = input_->header;
    result.sensor_origin_ = input_->sensor_origin_;
    result.sensor_orientation_ = input_->sensor_orientation_;
    const bool is_whole = indices_->size() == input_->size();
    result.resize(indices_->size());
    if (is_whole) result.width = input_->width;
    if (is_whole) result.height = input_->height;
    for (std::size_t r = 0; r < indices_->size(); ++r) {
      const pcl::index_t i = (*indices_)[r];
      const bool has_value = detail::hasValues(laplacian, i);
      result[r].x = (*input_)[i].x;
      result[r].y = (*input_)[i].y;
      result[r].z = (*input_)[i].z;
      result[r].intensity = has_value ? static_cast<float>(distance[i]) : std::numeric_limits<float>::quiet_NaN();
      result.is_dense = result.is_dense && std::isfinite(result[r].intensity);
    }
  });
  output = std::move(result);
}

template <typename PointT>
int tufted::GeodesicDistance<PointT>::radiusSearch(double radius, pcl::Indices& found, std::vector<float>& distances) {
  found.clear();
  distances.clear();
  run("radiusSearch", [&](const Laplacian& laplacian) {
    const NearbyPoints nearby = pointsWithin(laplacian, sources_, radius);
    std::vector<std::uint8_t> is_asked(input_->size(), 0);
    for (const pcl::index_t i : *indices_) is_asked[i] = 1;
    for (std::size_t j = 0; j < nearby.points.size(); ++j) {
      if (is_asked[nearby.points[j]] == 0) continue;
      found.push_back(nearby.points[j]);
      distances.push_back(static_cast<float>(nearby.distances[j]));
    }
  });
  return static_cast<int>(found.size());
}

#define PCL_INSTANTIATE_GeodesicDistance(T) template class PCL_EXPORTS tufted::GeodesicDistance<T>;
