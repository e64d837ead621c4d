#pragma once

#include <cstddef>
#include <memory>

#include "tufted/laplacian.h"

namespace tufted {

/// Builds the Laplacians of one frame after another and keeps the memory in between, arrays of the result included.
///
/// On one thread, a frame like the one before takes no memory from the heap, except in libraries: FLANN takes some for
/// its trees and searches, CGAL for numbers that a double cannot tell apart and for Delaunay::cgal. With several
/// threads a frame takes a little now and then: for the parallel sort, and because the memory that each thread needs
/// differs from run to run. A frame of another number of points takes new arrays for results of one value per point; a
/// larger one also takes what it needs in addition. Between frames the builder holds the result, with the capacity of
/// the largest one so far, and scratch memory of at most twice what the last frame had in use.
///
/// The results are bit for bit those of pointCloudLaplacian() and meshLaplacian(). A builder is for one thread at a
/// time, and must not be called from within `Progress`.
class LaplacianBuilder {
 public:
  LaplacianBuilder();
  ~LaplacianBuilder();
  /// What is moved from may be assigned to or destroyed, and nothing else.
  LaplacianBuilder(LaplacianBuilder&&) noexcept;
  /// What is moved from may be assigned to or destroyed, and nothing else.
  LaplacianBuilder& operator=(LaplacianBuilder&&) noexcept;

  /// Builds the Laplacian of a cloud; arguments and errors are those of pointCloudLaplacian().
  /// @returns the builder's own result, until the next call; copies last, and so do their covers. After an exception
  /// the result is that of no points. A cover() that is asked for takes new memory
  const Laplacian& pointCloud(const PointsRef& points, const CloudOptions& options = {});

  /// Builds the Laplacian of a mesh; arguments and errors are those of meshLaplacian(). The cover's memory is used
  /// again only with `keep_cover`.
  /// @returns the builder's own result, until the next call, as pointCloud() does
  const Laplacian& mesh(const PointsRef& points, const TrianglesRef& triangles, const MeshOptions& options = {});

  /// Forgets the result and gives all memory back.
  void release();

  /// Bytes held as scratch memory and as data from which covers are built on demand; arrays of the result are not
  /// counted.
  std::size_t bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tufted
