#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "tufted/types.h"

/// All fixtures of the tests and all checked-in datasets, with what is known about them analytically. Lengths have no
/// unit, except for scans, which are in metres. The same arguments give the same points.
namespace tufted::shapes {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
/// The number of eigenvalues that a fixture lists if they are known.
inline constexpr int known_eigenvalues = 100;

struct Cloud {
  std::string name{};      ///< unique in allClouds()
  std::string shape{};     ///< "sphere", "torus", ...
  std::string sampling{};  ///< "uniform", "scan_lines_10", ...
  std::uint64_t seed = 0;
  double noise = 0;           ///< standard deviation per coordinate (scans: along the beam)
  Points points{};            ///< NaN where a scanner saw nothing
  Points normals{};           ///< normals of the surface without noise; of scans towards the scanner
  double area = unknown;      ///< area of the surface
  int components = 1;         ///< connected components of the surface
  bool boundary = false;      ///< whether the surface has a boundary
  VectorXd eigenvalues{};     ///< ascending, zeros included; empty: unknown
  std::vector<int> labels{};  ///< sheet, face or wall of each point, -1: an outlier; empty: all the same
  int rim_points = 0;         ///< this many first points lie exactly on the boundary
  int outliers = 0;           ///< this many last points are not on the surface
  int width = 0, height = 0;  ///< size of an organized cloud, row-major; 0: not organized
};

struct Mesh {
  std::string name{};  ///< unique in allMeshes()
  std::string shape{};
  Points points{};
  Triangles triangles{};
  Polygons polygons{};           ///< faces of a polygon mesh, whose fan triangulation is `triangles`; otherwise empty
  double area = unknown;         ///< area of the shape; that of the triangles if `flat`, otherwise their limit
  bool flat = true;              ///< whether the triangles lie on the shape
  int components = 1;            ///< sets of triangles connected by vertices
  int boundary_edges = 0;        ///< edges of one triangle
  int nonmanifold_edges = 0;     ///< edges of three or more triangles
  int nonmanifold_vertices = 0;  ///< vertices around which triangles form several fans
  bool orientable = true;        ///< whether triangles can be oriented consistently across edges of two
  int euler = 0;           ///< referenced vertices - edges + triangles, of the triangles with three different corners
  VectorXd eigenvalues{};  ///< ascending, zeros included; empty: unknown
};

/// How points are distributed over a surface.
struct Sampling {
  enum class Kind { uniform, jittered, lattice, nonuniform, scan_lines, density_step };
  Kind kind;
  double anisotropy;         ///< distance between lines over distance along a line
  double density_ratio = 1;  ///< ratio of the densities on both sides of a step

  static const Sampling uniform;     ///< independent, uniform per area
  static const Sampling jittered;    ///< one point per cell of a grid, moved by up to 0.35 cells
  static const Sampling lattice;     ///< rows of equal steps; gives about n points
  static const Sampling nonuniform;  ///< independent, density varies smoothly by a factor of 16
  static constexpr Sampling scanLines(double anisotropy) { return {Kind::scan_lines, anisotropy}; }
  /// Independent; the density of the second half of the rows is less by the factor `ratio` >= 1.
  static constexpr Sampling densityStep(double ratio) { return {Kind::density_step, 1, ratio}; }
};
inline constexpr Sampling Sampling::uniform{Kind::uniform, 1};
inline constexpr Sampling Sampling::jittered{Kind::jittered, 1};
inline constexpr Sampling Sampling::lattice{Kind::lattice, 1};
inline constexpr Sampling Sampling::nonuniform{Kind::nonuniform, 1};

/// Whether there are points exactly on the boundary, in equal steps; they are the first ones of the cloud.
enum class Rim { none, included };

// Clouds ---------------------------------------------------------------------------------------------------------

Cloud sphere(int n, Sampling sampling = Sampling::uniform, std::uint64_t seed = 1);  ///< radius 1
/// Semi-axes 1.5, 1.25, 1; coordinates rounded to multiples of 2^-20, no value twice in one column (n <= 100,000).
Cloud ellipsoid(int n, std::uint64_t seed = 1);
Cloud square(int n, Sampling sampling = Sampling::uniform, Rim rim = Rim::none, std::uint64_t seed = 1);  ///< side 1
Cloud disk(int n, Sampling sampling = Sampling::uniform, Rim rim = Rim::none, std::uint64_t seed = 1);    ///< radius 1
Cloud torus(int n, Sampling sampling = Sampling::uniform, std::uint64_t seed = 1);  ///< R = 1, r = 0.4
/// Half a cylinder of radius 1 and height 2.
Cloud cylinderPatch(int n, Sampling sampling = Sampling::uniform, Rim rim = Rim::included, std::uint64_t seed = 1);
/// z = (x^2 - y^2)/2 over [-1, 1]^2.
Cloud saddle(int n, Sampling sampling = Sampling::uniform, Rim rim = Rim::none, std::uint64_t seed = 1);
/// side x side points of the plane z = 0 at multiples of `spacing`, row by row; exact if spacing has few bits. The area
/// is that of the square between the outermost points.
Cloud squareLattice(int side = 60, double spacing = 0.015625);
/// Unit squares z = 0 and z = distance; labels 0, 1.
Cloud twoSheets(int n, double distance, std::uint64_t seed = 1);
/// Unit squares around the origin in the planes z = 0 and y = 0, crossing along x; labels 0, 1. The eigenvalues are
/// those of four half squares that meet at the line (bookSpectrum), not of two separate squares.
Cloud crossingPlanes(int n, std::uint64_t seed = 1);
Cloud cubeSurface(int n, std::uint64_t seed = 1);   ///< [0, 1]^3; labels 0..5
Cloud prismSurface(int n, std::uint64_t seed = 1);  ///< the solid of prismMesh; labels 0..4

/// Two spheres of 1000 points each, far apart, of radius 1 and `radius`.
Points twoSpheres(double radius);

/// Distances on the unit sphere from one of its n points to all.
VectorXd sphereDistances(const Points& points, int from);

/// Isotropic Gaussian noise of standard deviation sigma; 0.01 is 1 % of the radius of the unit shapes.
Cloud withNoise(Cloud cloud, double sigma, std::uint64_t seed = 1);
/// Where outliers lie.
enum class Outliers {
  near,  ///< 2 to 6 spacings off the surface along its normal, on either side; a spacing is sqrt(area / points)
  far,   ///< anywhere in the surface's bounding box, enlarged by half about its centre; their normals are zero
};
/// Appends `share` times as many outliers as there are points.
Cloud withOutliers(Cloud cloud, Outliers where, double share, std::uint64_t seed = 1);
/// The points of a cloud in random order.
Cloud shuffled(Cloud cloud, std::uint64_t seed = 1);
/// n points, uniform per area; labels are triangle indices.
Cloud sampleMesh(const Mesh& mesh, int n, std::uint64_t seed = 1);

// Scans of a room of 20 x 15 x 4 m with a box and a pole in it -----------------------------------------------------

/// Surfaces that a beam can hit, the labels of scans.
enum class RoomSurface : int {
  floor,
  ceiling,
  wall_west,
  wall_east,
  wall_south,
  wall_north,
  box_west,
  box_east,
  box_south,
  box_north,
  box_top,
  pole
};

struct LidarOptions {
  int rings = 16;             ///< 16: -15 to 15 degrees; 32: -30.67 to 10.67 degrees; others: -24.8 to 2 degrees
  double azimuth_step = 0.4;  ///< degrees; divides 360
  double first_azimuth = 0;   ///< azimuth of the first column, in steps
  double noise = 0;           ///< standard deviation of the range, m
};
/// Scanner at the origin, floor at z = -1.8. Organized: a column per step of azimuth, a row per ring from the lowest.
/// The area is that of everything seen between the outermost rings.
Cloud lidar(const LidarOptions& options = {}, std::uint64_t seed = 1);

/// Facts about a scan without noise, for judging a noisy scan with the same rays.
struct ScanTruth {
  double area = 0;                  ///< area of triangles between neighbouring rays that hit one surface
  std::vector<std::uint8_t> inner;  ///< N; 1 if a ray and the eight around it hit one surface
};
/// @param scan organized, labelled, all points finite
/// @param goes_round whether the last column is a neighbour of the first, as in lidar()
ScanTruth scanTruth(const Cloud& scan, bool goes_round);

/// Whether the range that the scanner of lidar() sees jumps between two directions: at the edge of one body in front of
/// another, not where two surfaces meet.
/// @param a,b points in the scanner's frame, less than 180 degrees apart
bool crossesJump(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

struct DepthCameraOptions {
  int width = 640, height = 480;
  double depth_step = 0.002;  ///< depth is rounded to multiples of this, m; 0: not rounded
  double max_depth = 9;       ///< pixels beyond it are NaN, m
  double dropouts = 0.01;     ///< share of random pixels that are NaN
};
/// Pixels of a depth image without dropouts at which surfaces end, by the eight pixels around each.
struct ImageEdges {
  std::vector<std::uint8_t> rim;    ///< N; 1 if one of these sees nothing or is outside of the image
  std::vector<std::uint8_t> jump;   ///< N; 1 if one sees another surface, at least a twentieth nearer or farther
  std::vector<std::uint8_t> other;  ///< N; 1 if one sees another surface
};
/// @param image organized, labelled, depth along z
ImageEdges imageEdges(const Cloud& image);
/// Marks all pixels at most `pixels` rows and columns away from a marked one.
std::vector<std::uint8_t> widened(const std::vector<std::uint8_t>& marks, int width, int pixels);

/// A depth image by a camera at the origin, with z along the view and y down. Pixels that see a surface at less than 5
/// degrees are NaN too.
Cloud depthCamera(const DepthCameraOptions& options = {}, std::uint64_t seed = 1);

// Meshes ---------------------------------------------------------------------------------------------------------

/// How the points of a flat face are triangulated; the points do not depend on it.
enum class Quality {
  good,  ///< neighbouring rows zipped by the shorter diagonal
  bad,   ///< two fans per strip of a face: slivers as long as the face
};

/// [0, 1]^3, every face with (n + 1)^2 points, jittered along rows inside it.
Mesh cubeMesh(int n, Quality quality, std::uint64_t seed = 1);
/// A prism of height 1.5 over an equilateral triangle of side 1; every edge has n segments.
Mesh prismMesh(int n, Quality quality, std::uint64_t seed = 1);
Mesh cubeQuads(int n);  ///< [0, 1]^3 as 6 n^2 squares
Mesh prismQuads(
    int n);  ///< the sides of the prism as quadrilaterals, its ends as two n-gon-like polygons of 3n corners
Mesh tetrahedron();
Mesh icosphere(int subdivisions);  ///< 20 4^subdivisions triangles, corners on the unit sphere
Mesh gridSquare(int n);            ///< unit square, 2 n^2 triangles
/// Unit square pages, n x n each, that meet at one spine of n edges.
Mesh book(int pages, int n);
/// A unit square of n x n with two fins of height 1/4 along whole rows (n a multiple of 4, at least 8).
Mesh fins(int n);
Mesh bowTie();                ///< two triangles that share a vertex
Mesh bowTieCones(int sides);  ///< two cones without base that share their apex
Mesh moebius(int n);          ///< strip of width 0.8 about the unit circle, 4n x n
Mesh kleinBottle(int n);      ///< figure-eight immersion, 2n x n; crosses itself, no points coincide
/// gridSquare with caps of height 1e-10 along its middle row (n even).
Mesh slivers(int n);
Mesh zeroLengthEdges(int n);       ///< gridSquare with its middle row twice, joined by triangles without area (n even)
Mesh repeatedVertices(int n);      ///< gridSquare with additional triangles (a, a, b) and (a, a, a)
Mesh unreferencedVertices(int n);  ///< gridSquare with 3 unused points, the first one among them
Mesh duplicateTriangles(int n);    ///< gridSquare with its first triangle three times, once reversed
Mesh mixedOrientation(int n, std::uint64_t seed = 1);  ///< gridSquare with half of its triangles reversed
Mesh severalComponents();                              ///< a separate icosphere, square and tetrahedron

// Catalogues -----------------------------------------------------------------------------------------------------

/// Every cloud above in every sampling, of about `size` points each (at least 500); scans of similar size.
std::vector<Cloud> allClouds(int size);
/// Every mesh above, of some hundred triangles.
std::vector<Mesh> allMeshes();

}  // namespace tufted::shapes
