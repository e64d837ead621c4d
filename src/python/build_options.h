#pragma once

#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <optional>

#include "tufted/options.h"

// Options of a build as the package keeps them: a dict by the names of the arguments of PointCloud and Mesh. Of arrays
// it holds whether they were given.
namespace tufted::python {

/// The options of a cloud but those that are borrowed.
/// @throws InvalidInput for the name of a choice that there is not
CloudOptions cloudOptionsOf(const pybind11::dict& given);
/// The options of a mesh.
/// @throws InvalidInput for the name of a choice that there is not
MeshOptions meshOptionsOf(const pybind11::dict& given);
std::optional<Eigen::Vector3d> viewpointOf(const pybind11::dict& given);

}  // namespace tufted::python
