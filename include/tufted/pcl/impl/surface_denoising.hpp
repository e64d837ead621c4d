#pragma once

#include "tufted/pcl/impl/cloud_laplacian.hpp"
#include "tufted/pcl/surface_denoising.h"

template <typename PointT>
void tufted::SurfaceDenoising<PointT>::applyFilter(PointCloud& output) {
  output = *input_;
  report_ = {};
  const bool succeeded = detail::reported(getClassName(), "applyFilter", [&] {
    const detail::CloudInput input = detail::inputOf<PointT>(*input_, *indices_);
    const std::optional<ScanStructure> pixels = detail::pixelsOf(input, organized_);
    const DenoisedPoints denoised =
        denoise(input.points, {.structure = pixels ? &*pixels : nullptr, .threads = threads_});
    report_ = denoised.report;
    detail::sayWarnings(getClassName(), report_);
    output.is_dense = denoised.positions.allFinite();
    for (const pcl::index_t i : *indices_)
      if (denoised.noise[i] > 0)
        output[i].getVector3fMap() = denoised.positions.row(i).transpose().template cast<float>();
  });
  if (!succeeded) output.clear();
}

#define PCL_INSTANTIATE_SurfaceDenoising(T) template class PCL_EXPORTS tufted::SurfaceDenoising<T>;
