#pragma once

#include <algorithm>

#include "tufted/pcl/impl/surface_feature.hpp"
#include "tufted/pcl/spectral_signature_estimation.h"

template <typename PointInT, typename PointOutT>
void tufted::SpectralSignatureEstimation<PointInT, PointOutT>::fill(const PointInT&, const float* values,
                                                                    PointOutT& output) const {
  std::copy_n(values, samples, output.histogram);
}

#define PCL_INSTANTIATE_SpectralSignatureEstimation(T)                      \
  template class PCL_EXPORTS tufted::SurfaceFeature<T, pcl::Histogram<16>>; \
  template class PCL_EXPORTS tufted::SpectralSignatureEstimation<T, pcl::Histogram<16>>;
