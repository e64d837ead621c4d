#pragma once

#include <cstddef>
#include <memory>

#include "tufted/laplacian.h"

namespace tufted {

/// Builds the Laplacians of one frame after another and keeps the memory in between, arrays of the result included.
///
/// A frame like the one before takes nothing from the heap, on one thread and but for what the libraries below take:
/// FLANN for its trees and searches, CGAL for numbers that a double cannot tell apart and for Delaunay::cgal. With
/// several threads it takes a little now and then: the parallel sort, and who needs how much when differs every time. A
/// frame of another number of points takes new arrays for what holds one value per point in the result; larger ones
/// take what they need more. Between frames the result is held, with the room of the largest one so far, and scratch of
/// at most twice what the last frame had in use.
///
/// The results have the bits of pointCloudLaplacian() and meshLaplacian(). For one thread at a time, and not from
/// within `Progress`.
class LaplacianBuilder {
 public:
  LaplacianBuilder();
  ~LaplacianBuilder();
  LaplacianBuilder(LaplacianBuilder&&) noexcept;
  LaplacianBuilder& operator=(LaplacianBuilder&&) noexcept;

  /// See pointCloudLaplacian() for arguments and errors.
  /// @returns the builder's own result, until the next call; copies last, and so do their covers. After an exception
  /// the result is that of no points. A cover() that is asked for takes new memory
  const Laplacian& pointCloud(const Points& points, const CloudOptions& options = {});

  /// The same for meshLaplacian(). Only with `keep_cover` is the cover's memory used again.
  const Laplacian& mesh(const Points& points, const Triangles& triangles, const MeshOptions& options = {});

  /// Forgets the result and gives all memory back.
  void release();

  /// Bytes of scratch held, and of what covers on demand are made of; arrays of the result are not counted.
  std::size_t bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tufted
