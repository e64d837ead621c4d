#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "tufted/cloud_steps.h"
#include "tufted/scan_structure.h"
#include "tufted/types.h"

namespace tufted {

/// Called from the calling thread with a stage's name and the fraction of it that is begun, in [0, 1]. A stage may come
/// several times in a row, each time from 0; its names are for people and finer than those of Report::stages.
/// Returns false to stop the build, which then throws `Cancelled`.
using Progress = std::function<bool(std::string_view stage, double fraction)>;

/// Which edges of the union of stars count as one before Algorithm 1 (Sharp and Crane 2020) glues around them.
enum class Gluing {
  star,         ///< the two faces of p's star at a spoke meet each other only; link edges are shared between stars
  vertex_pair,  ///< all copies of an edge meet, as in the paper (5 % off on spectra at any N)
};

/// Circular order of the faces around an edge (Sharp and Crane 2020, Section 5.4).
enum class FaceOrder {
  angle,   ///< dihedral angle
  area,    ///< ascending area
  random,  ///< shuffled by `seed`
};

/// How the Delaunay stars are found. Both ways give the same triangles.
enum class Delaunay {
  star,  ///< angular sort and in-circle test around each point
  cgal,  ///< CGAL::Delaunay_triangulation_2 (GPL; needs TUFTED_WITH_GPL)
};

/// Kinds of clouds, see cloudSteps().
enum class Preset {
  clean,  ///< exact samples: the paper's steps and no others, the fastest
  scan,   ///< the default; depth images, laser scans, photogrammetry: noise, jumps, outliers, near sheets, rims; on
          ///< clean clouds as good as `clean`
  lidar,  ///< scans of a spinning scanner, whose rings `scan` would take for sheets
};

/// The steps for a kind of cloud, to change single ones of (see cloud_steps.h).
CloudSteps cloudSteps(Preset preset);

/// What stands for the intrinsic mollification of Sharp and Crane (2020, Section 4.5), 0 to 1: no edge is shorter than
/// this times the longest side of the smaller of its two triangles, and triangles that flips leave flat but for
/// rounding get a height of about 1e-7 of their longest side. Only edges that need it are lengthened, see
/// Report::area_added. 0 lengthens nothing: what is flat contributes nothing, and rounding may break the guarantees.
constexpr double default_mollify = 1e-6;

/// Options of pointCloudLaplacian().
struct CloudOptions {
  int neighbors = 30;                  ///< k >= 3, far fewer than N; larger than N - 1 is clamped and reported
  CloudSteps steps = {};               ///< most users set none of these and take cloudOptions(preset)
  Gluing gluing = Gluing::star;        ///< which edges of the stars count as one
  FaceOrder order = FaceOrder::angle;  ///< of the faces around an edge
  std::uint64_t seed = 0;              ///< for FaceOrder::random
  Delaunay delaunay = Delaunay::star;  ///< how the stars are found
  /// 0 to 1, see default_mollify.
  double mollify = default_mollify;
  int threads = 0;         ///< at most this many; 0: one per processor
  bool keep_cover = true;  ///< false frees what the cover is built from (about 100 bytes per point, up to 700 on noise)
  const Points* normals = nullptr;               ///< N x 3, any length, instead of the PCA's; keep their sign; borrowed
  const Neighborhoods* neighborhoods = nullptr;  ///< N x k indices used as they are, never grown; borrowed
  const ScanStructure* structure = nullptr;  ///< a depth image or the rings of a scanner, instead of a tree; borrowed
  /// Where the sensor stood, in the points' unit; normals face it, and it distinguishes Boundary::jump from rim however
  /// far the surfaces lie apart along the line of sight. Null: the origin of `structure`, if there is one. Borrowed.
  const Eigen::Vector3d* viewpoint = nullptr;
  Progress progress = {};  ///< called during the build
};

/// CloudOptions with the steps for a kind of cloud and defaults otherwise.
CloudOptions cloudOptions(Preset preset);

/// Options of meshLaplacian().
struct MeshOptions {
  FaceOrder order = FaceOrder::angle;  ///< of the faces around an edge
  std::uint64_t seed = 0;              ///< for FaceOrder::random
  /// 0 to 1, see default_mollify.
  double mollify = default_mollify;
  int threads = 0;         ///< at most this many; 0: one per processor
  bool keep_cover = true;  ///< false frees the cover (96 bytes per triangle)
  /// Whether vertices of equal position are joined. All keep their index: the later ones become
  /// PointStatus::coincident, and the first of each position stands for them.
  bool weld = false;
  Progress progress = {};  ///< called during the build
};

}  // namespace tufted
