#include <pcl/point_types.h>

#include <pcl/impl/instantiate.hpp>

#include "tufted/pcl/impl/laplacian_smoothing.hpp"
#include "tufted/pcl/impl/surface_denoising.hpp"

PCL_INSTANTIATE(LaplacianSmoothing, PCL_XYZ_POINT_TYPES)
PCL_INSTANTIATE(SurfaceDenoising, PCL_XYZ_POINT_TYPES)
