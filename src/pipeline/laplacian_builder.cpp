#include "tufted/laplacian_builder.h"

#include <optional>

#include "base/buffer.h"
#include "base/workspace.h"
#include "pipeline/build.h"

namespace tufted {

struct LaplacianBuilder::State {
  Workspace workspace;
  Laplacian result;

  /// Takes the place of L in forget(), because a new matrix, though empty, takes memory.
  std::optional<SparseMatrix> no_entries;

  template <class Build>
  const Laplacian& run(const Build& build) {
    if (!no_entries) no_entries.emplace();
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

  /// Empties the result and frees its memory. Takes none, because it is called when there is none left.
  void forget() noexcept {
    if (!no_entries) return;  // nothing was built since the last call
    // Names all members, so that a new one is not forgotten here.
    auto& [kind, L, M, cover_areas, status, representative, boundary, component, frames, positions, noise,
           component_edges, report, cover_source] = result;
    kind = Kind::mesh;
    L.swap(*no_entries);
    no_entries.reset();
    auto& [normals, tangents, orientation] = frames;
    orientation = Orientation::arbitrary;
    const auto freeAll = [](auto&... arrays) { (tufted::release(arrays), ...); };
    freeAll(M, cover_areas, status, representative, boundary, component, normals, tangents, positions, noise,
            component_edges);
    report = {};
    cover_source.reset();
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
