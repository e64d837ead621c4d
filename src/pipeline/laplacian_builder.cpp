#include "tufted/laplacian_builder.h"

#include "base/workspace.h"
#include "pipeline/build.h"

namespace tufted {

struct LaplacianBuilder::State {
  Workspace workspace;
  Laplacian result;

  template <class Build>
  const Laplacian& run(const Build& build) {
    const Workspace::Scope scope(&workspace);
    try {
      build();
    } catch (...) {
      forget();
      workspace.trim();
      throw;
    }
    workspace.trim();
    return result;
  }

  void forget() {
    result = {};
    SparseMatrix().swap(result.L);  // assignment would keep the memory
  }
};

LaplacianBuilder::LaplacianBuilder() : state_(std::make_unique<State>()) {}
LaplacianBuilder::~LaplacianBuilder() = default;
LaplacianBuilder::LaplacianBuilder(LaplacianBuilder&&) noexcept = default;
LaplacianBuilder& LaplacianBuilder::operator=(LaplacianBuilder&&) noexcept = default;

const Laplacian& LaplacianBuilder::pointCloud(const PointsRef& points, const CloudOptions& options) {
  return state_->run([&] { buildCloudLaplacian(points, options, CloudBuild::automatic, state_->result); });
}

const Laplacian& LaplacianBuilder::mesh(const PointsRef& points, const TrianglesRef& triangles,
                                        const MeshOptions& options) {
  return state_->run([&] { buildMeshLaplacian(points, triangles, options, state_->result); });
}

void LaplacianBuilder::release() {
  state_->forget();
  state_->workspace.release();
}

std::size_t LaplacianBuilder::bytes() const {
  return state_->workspace.bytes();
}

}  // namespace tufted
