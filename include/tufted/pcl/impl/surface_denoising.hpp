#pragma once

#include <pcl/console/print.h>

#include <exception>
#include <numeric>

#include "tufted/pcl/impl/cloud_laplacian.hpp"
#include "tufted/pcl/surface_denoising.h"

template <typename PointT>
void tufted::SurfaceDenoising<PointT>::applyFilter(PointCloud& output) {
  output = *input_;
  report_ = {};
  try {
    detail::checkIndices("setIndices", *input_, *indices_);
    pcl::Indices all(input_->size());
    std::iota(all.begin(), all.end(), 0);
    ScanStructure structure;
    if (organized_) structure = detail::pixelsOf(*input_, all);
    const DenoisedPoints denoised =
        denoise(detail::toPoints(*input_, all), {.structure = organized_ ? &structure : nullptr, .threads = threads_});
    report_ = denoised.report;
    detail::sayWarnings(getClassName(), report_);
    output.is_dense = denoised.positions.allFinite();
    for (const pcl::index_t i : *indices_)
      if (denoised.noise[i] > 0)
        output[i].getVector3fMap() = denoised.positions.row(i).transpose().template cast<float>();
  } catch (const std::exception& error) {
    PCL_ERROR("[tufted::%s::applyFilter] %s\n", getClassName().c_str(), error.what());
    output.clear();
  }
}

#define PCL_INSTANTIATE_SurfaceDenoising(T) template class PCL_EXPORTS tufted::SurfaceDenoising<T>;
