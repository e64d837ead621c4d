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

constexpr int compared = 40;  ///< positive eigenvalues

struct Settings {
  std::filesystem::path real = std::filesystem::path(TUFTED_DATA_DIR).parent_path() / "real";
  std::filesystem::path meshes = std::filesystem::path(TUFTED_CGAL_DATA_DIR) / "meshes";
  Half half = Half::held_out;
  int points = 0;  ///< 0: the default of each table
  double noise = 0;
  std::uint64_t first_seed = 101;
  int seeds = 1;
  int shapes = 6;                   ///< at most this many real shapes
  std::vector<std::string> rivals;  ///< empty: all
  std::filesystem::path file;       ///< the mesh of `cover`; empty: a sheared book of three pages
  std::filesystem::path picture;    ///< where the table, or the cover, is drawn; empty: nowhere
  std::filesystem::path page;       ///< where `cover` writes a page; empty: nowhere
  int k = 0;                        ///< instead of the one of each rival, if not 0

  int pointsOr(int otherwise) const { return points > 0 ? points : otherwise; }
};

/// The rivals of clouds that are asked for.
std::vector<CloudRival> rivalsOf(const Settings& settings);
/// The real shapes that are asked for.
std::vector<RealShape> shapesOf(const Settings& settings, int eigenvalues);

// Each prints a table and returns it.
Table printSpectrum(const Settings& settings);  ///< errors of eigenvalues on real shapes, a sphere and a torus
Table printNoise(const Settings& settings);     ///< the same against noise
Table printDensity(const Settings& settings);   ///< against a step of density
Table printLines(const Settings& settings);     ///< against the spacing of scan lines
Table printSheets(const Settings& settings);    ///< against the distance of two sheets
Table printBoundary(const Settings& settings);  ///< how far harmonic functions leave the range of their pins
Table printGreen(const Settings& settings);     ///< sizes, times and signs of Green's functions for several k
Table printOrders(const Settings& settings);    ///< eigenvalues with other orders of faces around edges
Table printThick(const Settings& settings);     ///< meshes that are not manifold beside tetrahedra that fill a layer
Table printDistance(const Settings& settings);  ///< errors of distances on the vertices of real shapes
Table printDataset(const Settings& settings);   ///< whether all guarantees hold on the meshes of a folder
Table printCover(const Settings& settings);     ///< the tufted cover and its intrinsic edges, as a drawing

}  // namespace tufted::bench
