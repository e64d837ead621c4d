#pragma once

#include <algorithm>
#include <optional>

#include "tufted/components.h"
#include "tufted/pcl/impl/cloud_laplacian.hpp"
#include "tufted/pcl/surface_segmentation.h"

template <typename PointT>
void tufted::SurfaceSegmentation<PointT>::segment(std::vector<pcl::PointIndices>& clusters) {
  clusters.clear();
  if (!this->initCompute()) return;
  detail::reported(getClassName(), "segment", [&] {
    const detail::CloudInput input =
        detail::wholeInput<PointT>(input_, *indices_, this->hasGivenSurface() ? nullptr : search_, this->getKSearch());
    const Laplacian& laplacian = this->surfaceOf(getClassName(), input);
    const std::vector<int> labels =
        count_ == 0 && method_ != SegmentMethod::parts
            ? componentLabels(laplacian)
            : segments(laplacian, {.method = method_,
                                   .count = count_ == 0 ? std::nullopt : std::optional<int>(count_),
                                   .crease = crease_,
                                   .solver = {.threads = this->getOptions().threads}})
                  .labels;
    const int most_label = labels.empty() ? -1 : *std::max_element(labels.begin(), labels.end());
    std::vector<pcl::PointIndices> all(static_cast<std::size_t>(most_label + 1));
    for (const pcl::index_t i : *indices_)
      if (labels[i] >= 0) all[labels[i]].indices.push_back(i);
    for (pcl::PointIndices& cluster : all) {
      const auto size = static_cast<int>(cluster.indices.size());
      if (size < std::max(least_, 1) || size > most_) continue;
      cluster.header = input_->header;
      clusters.push_back(std::move(cluster));
    }
  });
  this->deinitCompute();
}

#define PCL_INSTANTIATE_SurfaceSegmentation(T) template class PCL_EXPORTS tufted::SurfaceSegmentation<T>;
