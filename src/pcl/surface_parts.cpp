#include <pcl/point_types.h>

#include <pcl/impl/instantiate.hpp>

#include "tufted/pcl/impl/geodesic_distance.hpp"
#include "tufted/pcl/impl/surface_segmentation.hpp"
#include "tufted/pcl/impl/surface_triangulation.hpp"

PCL_INSTANTIATE(GeodesicDistance, PCL_XYZ_POINT_TYPES)
PCL_INSTANTIATE(SurfaceSegmentation, PCL_XYZ_POINT_TYPES)
PCL_INSTANTIATE(SurfaceTriangulation, PCL_XYZ_POINT_TYPES)
