#pragma once

#include <cstddef>
#include <memory>

#include "tufted/laplacian.h"

namespace tufted {

/// Builds the Laplacians of one frame of a sequence after another, and keeps the memory in between, also that of the
/// result. The results are bit for bit those of pointCloudLaplacian() and meshLaplacian(). A builder is for one thread
/// at a time, and must not be called from within `Progress`.
///
/// On one thread, a frame like the one before takes no memory from the heap, except in libraries: FLANN takes some for
/// its trees and searches, CGAL for exact numbers and for Delaunay::cgal. With several threads a frame may take a
/// little, for the parallel sort, and because the memory that a thread needs varies from run to run. A frame with
/// another number of points takes new arrays for results with one value per point, and a larger one what it needs in
/// addition. Between frames the builder holds the result, with the capacity of the largest one so far, and scratch
/// memory of at most twice what the last frame used.
class LaplacianBuilder {
 public:
  LaplacianBuilder();
  ~LaplacianBuilder();
  /// A moved-from builder may only be destroyed or assigned to.
  LaplacianBuilder(LaplacianBuilder&&) noexcept;
  /// A moved-from builder may only be destroyed or assigned to.
  LaplacianBuilder& operator=(LaplacianBuilder&&) noexcept;

  /// Builds the Laplacian of a cloud; arguments and errors are those of pointCloudLaplacian().
  /// @return the builder's own result, valid until the next call; copies of it stay valid, with their covers. After an
  /// exception it has no points. cover() takes new memory when it is called.
  const Laplacian& pointCloud(const PointsRef& points, const CloudOptions& options = {});

  /// Builds the Laplacian of a mesh; arguments and errors are those of meshLaplacian(). The memory of the cover is
  /// reused only with `keep_cover`.
  /// @return the builder's own result, as pointCloud()
  const Laplacian& mesh(const PointsRef& points, const TrianglesRef& triangles, const MeshOptions& options = {});

  /// Discards the result and frees all memory.
  void release();

  /// Bytes of scratch memory, and of the data from which covers are built on demand; arrays of the result are not
  /// counted.
  std::size_t bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tufted
