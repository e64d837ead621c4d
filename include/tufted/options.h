#pragma once

#include <functional>
#include <string_view>

#include "tufted/cloud_steps.h"
#include "tufted/paper_options.h"
#include "tufted/scan_structure.h"
#include "tufted/types.h"

namespace tufted {

/// Progress callback, called from the calling thread with the name of a stage and the fraction of it that is begun, in
/// [0, 1]. A stage may come several times in a row, each time from 0. Stage names are for people and finer than those
/// in Report::stages. The callback returns false to stop the call, which then throws `Cancelled`.
using Progress = std::function<bool(std::string_view stage, double fraction)>;

/// Kinds of clouds, each with its own CloudSteps.
enum class Preset {
  clean,  ///< exact samples of a surface: the steps of the paper only; the fastest
  scan,  ///< depth images, laser scans, photogrammetry, with noise, jumps, outliers, near sheets and rims; the default,
         ///< as accurate as `clean` on exact samples
  lidar,  ///< scans of a spinning scanner, whose rings `scan` would mistake for sheets
};

/// The steps for a kind of cloud, of which a caller may change single ones.
CloudSteps cloudSteps(Preset preset);

/// Default of `mollify`, which takes the place of the intrinsic mollification of Sharp and Crane (2020, Section 4.5).
/// Range [0, 1]: no edge is shorter than this times the longest side of the smaller of its two triangles, and triangles
/// that flips leave flat up to rounding get a height of about 1e-7 of their longest side. Only edges that need it are
/// lengthened, see Report::area_added. With 0 none are: flat triangles then contribute nothing, and rounding may break
/// the guarantees of L.
constexpr double default_mollify = 1e-6;

/// Options of pointCloudLaplacian().
struct CloudOptions {
  int neighbors = 30;     ///< k >= 3, far fewer than N; more than N - 1 is clamped and reported
  CloudSteps steps = {};  ///< for expert use; cloudOptions(preset) sets them for a kind of cloud
  /// Least edge length relative to the longest side of a triangle, in [0, 1], see default_mollify.
  double mollify = default_mollify;
  int threads = 0;         ///< at most this many threads; 0: one per processor
  bool keep_cover = true;  ///< false frees what the cover is built from (about 100 bytes per point, up to 700 on noise)
  /// N x 3, any length, used instead of those of the PCA. Signs matter: points with opposed normals may be the two
  /// sides of a thin part, and are then no neighbours however close they are. Signs at random change little. Borrowed.
  const Points* normals = nullptr;
  const Neighborhoods* neighborhoods = nullptr;  ///< N x k indices, used as they are and never grown; borrowed
  const ScanStructure* structure = nullptr;      ///< pixels of a depth image or rings of a scanner, used instead of a
                                                 ///< search tree; borrowed
  /// Position of the sensor, in the unit of the points. Normals face it, and it distinguishes Boundary::jump from rim
  /// however far apart the surfaces lie along the line of sight. Null: the origin of `structure`, if given. Borrowed.
  const Eigen::Vector3d* viewpoint = nullptr;
  Progress progress = {};   ///< called during the build
  PaperOptions paper = {};  ///< for comparison with the paper
};

/// CloudOptions with the steps for a kind of cloud and defaults for everything else.
CloudOptions cloudOptions(Preset preset);

/// Options of meshLaplacian().
struct MeshOptions {
  /// Least edge length relative to the longest side of a triangle, in [0, 1], see default_mollify.
  double mollify = default_mollify;
  int threads = 0;         ///< at most this many threads; 0: one per processor
  bool keep_cover = true;  ///< false frees the cover (96 bytes per triangle)
  /// Whether vertices of equal position are joined. All keep their index: the first of each position represents the
  /// others, which become PointStatus::coincident.
  bool weld = false;
  Progress progress = {};   ///< called during the build
  PaperOptions paper = {};  ///< for comparison with the paper
};

}  // namespace tufted
