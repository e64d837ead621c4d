#include "tufted/pcl/laplacian_smoothing.h"

#include <pcl/point_types.h>

#include <pcl/impl/instantiate.hpp>

#include "tufted/pcl/impl/laplacian_smoothing.hpp"

PCL_INSTANTIATE(LaplacianSmoothing, PCL_XYZ_POINT_TYPES)
