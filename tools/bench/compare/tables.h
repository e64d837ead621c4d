#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/compare/rivals.h"
#include "bench/compare/table.h"
#include "bench/real_shapes.h"

namespace tufted::bench {

struct Settings {
  std::filesystem::path real = std::filesystem::path(TUFTED_DATA_DIR).parent_path() / "real";
  std::filesystem::path meshes = std::filesystem::path(TUFTED_CGAL_DATA_DIR) / "meshes";
  Half half = Half::held_out;
  int points = 0;  ///< 0: the default of each table
  double noise = 0;
  std::uint64_t first_seed = 101;
  int seeds = 1;
  int shapes = 6;                 ///< at most this many real shapes
  std::filesystem::path file;     ///< the mesh of `cover`; empty: a sheared book of three pages
  std::filesystem::path picture;  ///< where `cover` draws; empty: nowhere
  int k = 0;                      ///< instead of the one of each rival, if not 0

  int pointsOr(int otherwise) const { return points > 0 ? points : otherwise; }
};

/// The real shapes that are asked for.
std::vector<RealShape> shapesOf(const Settings& settings, int eigenvalues);

// Each prints a table.
void printSpectrum(const Settings& settings);  ///< errors of eigenvalues on real shapes, a sphere and a torus
void printNoise(const Settings& settings);     ///< the same against noise
void printDensity(const Settings& settings);   ///< against a step of density
void printLines(const Settings& settings);     ///< against the spacing of scan lines
void printSheets(const Settings& settings);    ///< against the distance of two sheets
void printBoundary(const Settings& settings);  ///< how far harmonic functions leave the range of their pins
void printGreen(const Settings& settings);     ///< sizes, times and signs of Green's functions for several k
void printOrders(const Settings& settings);    ///< eigenvalues with other orders of faces around edges
void printThick(const Settings& settings);     ///< meshes that are not manifold beside tetrahedra that fill a layer
void printDistance(const Settings& settings);  ///< errors of distances on the vertices of real shapes
void printDataset(const Settings& settings);   ///< whether all guarantees hold on the meshes of a folder
void printCover(const Settings& settings);     ///< the tufted cover and its intrinsic edges, as a drawing

}  // namespace tufted::bench
