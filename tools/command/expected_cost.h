#pragma once

#include <vector>

#include "structure.h"
#include "tufted/io/read.h"
#include "tufted/options.h"

/// What `tufted laplacian FILE --out DIR` is expected to take.
struct ExpectedCost {
  double seconds = 0;
  double bytes = 0;  ///< peak memory
};

/// The middle rows of an organized cloud, about `most` points of consecutive indices.
std::vector<int> middleRows(const tufted::Geometry& geometry, int most);

/// Builds a sample of a cloud with the default options, and extrapolates from its cost to all points.
/// @param sample indices as those of tufted::sampleRegions(), or middleRows() for a depth image
/// @param structure of the build, none or image
/// @param options neighbours, threads and progress of the build
ExpectedCost expectedCost(const tufted::Geometry& geometry, const std::vector<int>& sample, Structure structure,
                          tufted::CloudOptions options);

/// Adds the program, and the reading and writing of files, to the cost of a build.
/// @param seconds,bytes of the build
ExpectedCost withFiles(double seconds, double bytes, double points);
