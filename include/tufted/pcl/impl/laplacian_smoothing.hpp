#pragma once

#include <cstdint>
#include <vector>

#include "tufted/pcl/impl/cloud_laplacian.hpp"
#include "tufted/pcl/laplacian_smoothing.h"

template <typename PointT>
void tufted::LaplacianSmoothing<PointT>::applyFilter(PointCloud& output) {
  output = *input_;
  report_ = {};
  const bool succeeded = detail::reported(getClassName(), "applyFilter", [&] {
    const detail::CloudInput input =
        detail::wholeInput<PointT>(input_, *indices_, this->hasGivenSurface() ? nullptr : search_, this->getKSearch());
    std::vector<std::uint8_t> fixed(input_->size(), 1);
    for (const pcl::index_t i : *indices_) fixed[i] = 0;
    const Laplacian& laplacian = this->surfaceOf(getClassName(), input);
    report_ = laplacian.report;
    const Points smoothed = smooth(laplacian, input.points,
                                   {.time_step = time_step_,
                                    .iterations = iterations_,
                                    .fixed = &fixed,
                                    .solver = {.threads = this->getOptions().threads}});
    output.is_dense = smoothed.allFinite();
    for (std::size_t i = 0; i < output.size(); ++i)
      output[i].getVector3fMap() = smoothed.row(static_cast<Eigen::Index>(i)).transpose().template cast<float>();
  });
  if (!succeeded) output.clear();
}

#define PCL_INSTANTIATE_LaplacianSmoothing(T) template class PCL_EXPORTS tufted::LaplacianSmoothing<T>;
