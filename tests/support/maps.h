#pragma once

#include "shapes/shapes.h"
#include "tufted/parameterization.h"
#include "tufted/tufted.h"

namespace tufted::support {

inline const ParameterizationOptions tutte{.method = ParameterizationMethod::harmonic};
inline const ParameterizationOptions mean_value{.method = ParameterizationMethod::harmonic,
                                                .weights = HarmonicWeights::mean_value};

inline Eigen::MatrixX2d mapMesh(const shapes::Mesh& mesh, const ParameterizationOptions& options = {},
                                ParameterizationReport* report = nullptr) {
  return parameterize(meshLaplacian(mesh.points, mesh.triangles), mesh.triangles, options, report);
}

}  // namespace tufted::support
