#include <pcl/point_types.h>

#include <pcl/impl/instantiate.hpp>

#include "tufted/pcl/impl/oriented_normal_estimation.hpp"
#include "tufted/pcl/impl/principal_curvature_estimation.hpp"
#include "tufted/pcl/impl/spectral_signature_estimation.hpp"
#include "tufted/pcl/impl/surface_boundary_estimation.hpp"

PCL_INSTANTIATE(OrientedNormalEstimation, PCL_XYZ_POINT_TYPES)
PCL_INSTANTIATE(PrincipalCurvatureEstimation, PCL_XYZ_POINT_TYPES)
PCL_INSTANTIATE(SpectralSignatureEstimation, PCL_XYZ_POINT_TYPES)
PCL_INSTANTIATE(SurfaceBoundaryEstimation, PCL_XYZ_POINT_TYPES)
