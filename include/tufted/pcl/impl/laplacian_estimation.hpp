#pragma once

#include "tufted/pcl/impl/cloud_laplacian.hpp"
#include "tufted/pcl/laplacian_estimation.h"

template <typename PointT>
template <class Build>
bool tufted::LaplacianEstimation<PointT>::run(const Build& build) {
  if (!this->initCompute()) return false;
  const bool succeeded = detail::reported(getClassName(), "compute", [&] {
    detail::CloudInput input = detail::inputOf<PointT>(*input_, *indices_);
    if (!fake_indices_) input.indices = indices_.get();
    if (search_)
      input.neighborhoods = detail::nearestNeighbors<PointT>(*search_, input_, *indices_, input, this->getKSearch());
    const Laplacian& result = build(input);
    detail::sayWarnings(getClassName(), result.report);
  });
  this->deinitCompute();
  return succeeded;
}

template <typename PointT>
std::shared_ptr<const tufted::Laplacian> tufted::LaplacianEstimation<PointT>::compute() {
  std::shared_ptr<const Laplacian> result;
  const bool succeeded = run([&](const detail::CloudInput& input) -> const Laplacian& {
    result = this->build(input);
    return *result;
  });
  return succeeded ? result : std::make_shared<const Laplacian>();
}

template <typename PointT>
void tufted::LaplacianEstimation<PointT>::compute(Laplacian& result) {
  result = {};
  run([&](const detail::CloudInput& input) -> const Laplacian& {
    this->withOptions(input, [&](const PointsRef& points, const CloudOptions& options) {
      result = pointCloudLaplacian(points, options);
    });
    return result;
  });
}

#define PCL_INSTANTIATE_LaplacianEstimation(T) template class PCL_EXPORTS tufted::LaplacianEstimation<T>;
