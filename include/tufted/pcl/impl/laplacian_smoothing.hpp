#pragma once

#include <pcl/console/print.h>

#include <cstdint>
#include <exception>
#include <numeric>
#include <vector>

#include "tufted/pcl/impl/cloud_laplacian.hpp"
#include "tufted/pcl/laplacian_smoothing.h"

template <typename PointT>
void tufted::LaplacianSmoothing<PointT>::applyFilter(PointCloud& output) {
  output = *input_;
  report_ = {};
  try {
    detail::checkIndices("setIndices", *input_, *indices_);
    std::vector<std::uint8_t> fixed(input_->size(), 1);
    for (const pcl::index_t i : *indices_) fixed[i] = 0;

    pcl::Indices all(input_->size());
    std::iota(all.begin(), all.end(), 0);
    const Points points = detail::toPoints(*input_, all);
    const Laplacian laplacian = detail::cloudLaplacian<PointT>(input_, all, points, search_, organized_, options_);
    report_ = laplacian.report;
    detail::sayWarnings(getClassName(), report_);
    const Points smoothed = smooth(
        laplacian, points,
        {.time_step = time_step_, .iterations = iterations_, .fixed = &fixed, .solver = {.threads = options_.threads}});

    output.is_dense = smoothed.allFinite();
    for (const pcl::index_t i : all) {
      output[i].getVector3fMap() = smoothed.row(i).transpose().template cast<float>();
    }
  } catch (const std::exception& error) {
    PCL_ERROR("[tufted::%s::applyFilter] %s\n", getClassName().c_str(), error.what());
    output.clear();
  }
}

#define PCL_INSTANTIATE_LaplacianSmoothing(T) template class PCL_EXPORTS tufted::LaplacianSmoothing<T>;
