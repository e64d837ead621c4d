#pragma once

#include <pcl/point_types.h>

#include <type_traits>
#include <vector>

#include "tufted/pcl/surface_feature.h"

namespace tufted {

/// Computes the heat or wave kernel signature of each point, which does not change when the surface moves or bends.
///
/// Positive eigenvalues alone are used, see spectrum(); heat that is spread evenly over a component is added.
/// Signatures have the unit 1 / length^2. See SurfaceFeature for what all features have in common.
///
/// Instantiated for PCL_XYZ_POINT_TYPES and the output pcl::Histogram<16>; for other types, such as
/// pcl::Histogram<100>, include impl/spectral_signature_estimation.hpp.
/// @tparam PointOutT has an array of floats `histogram`, one entry per sample
template <typename PointInT, typename PointOutT = pcl::Histogram<16>>
class SpectralSignatureEstimation : public SurfaceFeature<PointInT, PointOutT> {
 public:
  /// Shared pointer, as PCL's classes have it.
  using Ptr = pcl::shared_ptr<SpectralSignatureEstimation<PointInT, PointOutT>>;
  /// Shared pointer to const, as PCL's classes have it.
  using ConstPtr = pcl::shared_ptr<const SpectralSignatureEstimation<PointInT, PointOutT>>;
  /// Number of samples.
  static constexpr int samples = std::extent_v<decltype(PointOutT::histogram)>;

  SpectralSignatureEstimation() { this->feature_name_ = "SpectralSignatureEstimation"; }

  /// Which signature is computed; Signature::heat by default.
  void setSignature(Signature signature) { settings_.kind = signature; }
  /// See setSignature().
  Signature getSignature() const { return settings_.kind; }

  /// Number of positive eigenvalues, at least 2; all there are if fewer; 100 by default.
  void setEigenpairs(int count) { settings_.eigenpairs = count; }
  /// See setEigenpairs().
  int getEigenpairs() const { return settings_.eigenpairs; }

  /// Times in length^2 (heat), or natural logarithms of eigenvalues (wave), at least two, ascending in equal steps; one
  /// per entry of the output. Signatures of two clouds are comparable if they have the same. Empty (default): those of
  /// heatTimes() or waveEnergies() for each cloud.
  void setSamples(std::vector<double> values) { settings_.samples = std::move(values); }
  /// The times or energies of the last computation.
  const std::vector<double>& getSamples() const { return used_; }

 private:
  detail::PointValues valuesOf(const Laplacian& laplacian, const Eigen::Vector3d*) override {
    return detail::signatures(laplacian, settings_, samples, used_, this->getOptions().threads);
  }
  void fill(const PointInT&, const float* values, PointOutT& output) const override;

  detail::SignatureSettings settings_;
  std::vector<double> used_;
};

}  // namespace tufted

#ifdef PCL_NO_PRECOMPILE
#include "tufted/pcl/impl/spectral_signature_estimation.hpp"
#endif
