#pragma once

#include <vector>

#include "tufted/laplacian.h"

namespace tufted {

/// Which signature SpectralSignatureEstimation computes.
enum class Signature {
  heat,  ///< heatKernelSignature(), which sums up the surface from near to far
  wave,  ///< waveKernelSignature(), which separates the scales
};

/// What the features of PCL clouds hold, the same for all types of points.
namespace detail {

/// One row of values per point.
using PointValues = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Settings of signatures().
struct SignatureSettings {
  Signature kind = Signature::heat;  ///< which signature
  int eigenpairs = 100;              ///< see SpectralSignatureEstimation::setEigenpairs()
  std::vector<double> samples = {};  ///< see SpectralSignatureEstimation::setSamples()
};

/// @param viewpoint null: normals face outwards
/// @return N x 4: normal and mean curvature, NaN unless `curvature` is asked for
PointValues normalsAndCurvature(const Laplacian& laplacian, const Eigen::Vector3d* viewpoint, bool curvature,
                                int threads);

/// @param viewpoint null: normals face outwards
/// @return N x 5: direction of the first principal curvature, and both curvatures
PointValues principalCurvatures(const Laplacian& laplacian, const Eigen::Vector3d* viewpoint, int threads);

/// @return N x 1: the kinds of Laplacian::boundary
PointValues boundaryKinds(const Laplacian& laplacian);

/// @param count number of samples
/// @param[out] samples those that were used
/// @return N x count
PointValues signatures(const Laplacian& laplacian, const SignatureSettings& settings, int count,
                       std::vector<double>& samples, int threads);

}  // namespace detail

}  // namespace tufted
