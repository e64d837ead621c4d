#pragma once

#include "tufted/pcl/impl/cloud_laplacian.hpp"
#include "tufted/pcl/surface_feature.h"

template <typename PointInT>
bool tufted::detail::FeatureRows<PointInT>::computeRows(const std::string& class_name, const Given& given,
                                                        PointValues& rows, bool& all) {
  return reported(class_name, "compute", [&] {
    refuseSearches(given.radius, given.search_surface && given.search_surface != given.input);
    neighbors_ = given.k != 0 ? std::optional<int>(given.k) : std::nullopt;
    const CloudInput input = wholeInput<PointInT>(given.input, given.indices,
                                                  hasGivenSurface() ? nullptr : given.search, getOptions().neighbors);
    const Laplacian& laplacian = surfaceOf(class_name, input);
    rows = rowsOf(laplacian, valuesOf(laplacian, viewpointOf(input)), given.indices, all);
  });
}

template <typename PointInT, typename PointOutT>
void tufted::SurfaceFeature<PointInT, PointOutT>::computeFeature(PointCloudOut& output) {
  detail::PointValues rows;
  bool all = false;
  if (!this->computeRows(getClassName(), {input_, surface_, tree_, *indices_, k_, search_radius_}, rows, all))
    return output.clear();
  for (std::size_t r = 0; r < indices_->size(); ++r)
    fill((*input_)[(*indices_)[r]], rows.data() + static_cast<Eigen::Index>(r) * rows.cols(), output[r]);
  output.is_dense = all;
}
