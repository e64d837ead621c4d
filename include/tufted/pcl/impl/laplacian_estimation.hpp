#pragma once

#include <pcl/console/print.h>

#include <exception>

#include "tufted/pcl/impl/cloud_laplacian.hpp"
#include "tufted/pcl/laplacian_estimation.h"

template <typename PointT>
void tufted::LaplacianEstimation<PointT>::compute(Laplacian& result) {
  result = {};
  if (!this->initCompute()) return;
  try {
    detail::checkIndices("setIndices", *input_, *indices_);
    const Points points = detail::toPoints(*input_, *indices_);
    CloudOptions options = options_;
    const Eigen::Vector3d sensor = input_->sensor_origin_.template head<3>().template cast<double>();
    if (options.viewpoint == nullptr && input_->isOrganized()) options.viewpoint = &sensor;
    result = detail::cloudLaplacian<PointT>(input_, *indices_, points, search_, organized_, options);
    detail::sayWarnings(getClassName(), result.report);
  } catch (const std::exception& error) {
    PCL_ERROR("[tufted::%s::compute] %s\n", getClassName().c_str(), error.what());
  }
  this->deinitCompute();
}

#define PCL_INSTANTIATE_LaplacianEstimation(T) template class PCL_EXPORTS tufted::LaplacianEstimation<T>;
