#pragma once

#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <optional>

#include "tufted/options.h"

// The package keeps the options of a build as a dict whose keys are the arguments of PointCloud and Mesh. Instead of
// arrays it holds whether they were given.
namespace tufted::python {

/// The options of a cloud, without the borrowed arrays.
/// @throws InvalidInput for a name of a preset, gluing, order or delaunay that does not exist
CloudOptions cloudOptionsOf(const pybind11::dict& given);
/// The options of a mesh.
/// @throws InvalidInput for a name of an order that does not exist
MeshOptions meshOptionsOf(const pybind11::dict& given);
std::optional<Eigen::Vector3d> viewpointOf(const pybind11::dict& given);

}  // namespace tufted::python
