#include "tufted/pcl/surface_denoising.h"

#include <pcl/point_types.h>

#include <pcl/impl/instantiate.hpp>

#include "tufted/pcl/impl/surface_denoising.hpp"

PCL_INSTANTIATE(SurfaceDenoising, PCL_XYZ_POINT_TYPES)
