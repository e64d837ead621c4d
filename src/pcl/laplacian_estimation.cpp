#include "tufted/pcl/laplacian_estimation.h"

#include <pcl/point_types.h>

#include <pcl/impl/instantiate.hpp>

#include "tufted/pcl/impl/laplacian_estimation.hpp"

PCL_INSTANTIATE(LaplacianEstimation, PCL_XYZ_POINT_TYPES)
