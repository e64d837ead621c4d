#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tufted {

/// Cost of one stage of a build.
struct StageCost {
  std::string name;       ///< "neighbors", "stars", ...
  double seconds = 0;     ///< wall-clock; stages that share a parallel loop divide its time by their CPU shares
  std::size_t bytes = 0;  ///< memory of what the stage leaves behind
};

/// Counts, areas and timings of a build. Odd data is never printed and never throws: it is counted here.
struct Report {
  // Input
  std::int64_t points = 0;      ///< rows of the caller's array
  std::int64_t active = 0;      ///< points with a positive diagonal
  std::int64_t not_finite = 0;  ///< points of PointStatus::not_finite
  std::int64_t coincident = 0;  ///< points merged with an earlier equal one (clouds, and meshes with MeshOptions::weld)
  std::int64_t isolated = 0;    ///< points without a triangle

  std::int64_t rim_points = 0;   ///< active points of Boundary::rim
  std::int64_t jump_points = 0;  ///< active points of Boundary::jump
  std::int64_t lost_points = 0;  ///< active points of Boundary::lost

  // Clouds
  int neighbors = 0;  ///< k in use: clamped to N - 1; the longest of the caller's lists; at most 48 in a depth image
  bool neighbors_clamped = false;        ///< whether the k asked for exceeded N - 1
  std::int64_t rejected_normals = 0;     ///< caller's normals that are zero or not finite, replaced by those of the PCA
  std::int64_t rejected_neighbors = 0;   ///< caller's neighbours that are repeated, unusable or the point itself
  double sparse_share = 0;               ///< sparseShare() of the depth image; 0 without one
  std::int64_t unplaced = 0;             ///< usable points that have no place in the structure of the scan
  std::int64_t cut_neighbors = 0;        ///< neighbours in the scan left out because the surface jumps in between
  std::int64_t grown_neighborhoods = 0;  ///< neighbourhoods that grew, see Growth; of a depth image windows widened
  std::int64_t split_neighborhoods = 0;  ///< neighbourhoods from which neighbours on other sheets were left out
  std::int64_t isolated_by_sheets = 0;   ///< points without a star because nearly all neighbours lie on other sheets
  std::int64_t thick_neighborhoods = 0;  ///< neighbourhoods of one sheet, or of the nearest 8 along a line, whose least
                                         ///< variance is above half of the middle one: thin bodies, cables, volumes
  std::int64_t outliers = 0;             ///< points without a star, see CloudSteps::isolate_outliers
  std::int64_t denoised = 0;             ///< points moved onto the surface, see CloudSteps::denoise
  /// Median of Laplacian::noise over the points that were moved, in the caller's unit; 0 if none was.
  double noise = 0;
  std::int64_t grown_stars = 0;        ///< closed stars computed again because a circumcircle left the searched ball
  std::int64_t closed_stars = 0;       ///< open stars that closed with more neighbours
  std::int64_t open_stars = 0;         ///< points whose star is open
  std::int64_t dropped_triangles = 0;  ///< star triangles removed: filtered, of outliers, too flat, across jumps
  std::int64_t settled_diagonals = 0;  ///< quadrilaterals whose stars were made to agree, see CloudSteps
  std::array<std::int64_t, 3> votes = {};  ///< distinct triangles that the stars of 1, 2 and 3 of their corners have

  // Meshes
  std::int64_t repeated_vertex_triangles = 0;  ///< dropped: a vertex occurs twice
  std::int64_t not_finite_triangles = 0;       ///< dropped: a vertex is not finite
  std::int64_t boundary_edges = 0;             ///< edges of exactly one triangle
  std::int64_t nonmanifold_edges = 0;          ///< edges of more than two triangles

  // Cover
  std::int64_t triangles = 0;    ///< triangles under the cover, copies included; the cover has twice as many faces
  double mean_edge = 0;          ///< mean length of the triangles' sides before mollification, in the caller's unit
  double mean_squared_edge = 0;  ///< mean squared length of the triangles' sides before mollification
  std::int64_t lengthened_edges = 0;  ///< edges of the cover that mollification lengthened, see default_mollify
  double area_added = 0;              ///< `cover_area` less the area of the triangles between the points, in length^2:
                                      ///< from lengthened edges, and from rounding in thin triangles; 0 on clouds
                                      ///< without flat triangles
  std::int64_t degenerate_faces = 0;  ///< cover faces without area even so; they contribute nothing
  std::int64_t flips = 0;             ///< intrinsic edge flips
  std::int64_t flip_failures = 0;     ///< edges that were not Delaunay when flipping gave up; 0 unless something is
                                      ///< wrong

  // Operator
  double area = 0;                   ///< sum of M, length^2
  double cover_area = 0;             ///< sum of Laplacian::cover_areas; equal to `area` with Mass::cover
  std::int64_t star_masses = 0;      ///< points whose mass is an area of their own star, see Mass::star; 0 on meshes
  std::int64_t nonzeros = 0;         ///< stored entries of L
  std::int64_t components = 0;       ///< connected components of the active points
  std::int64_t clamped_weights = 0;  ///< negative weights set to 0, within 1e-9 of the larger diagonal
  std::int64_t clamped_large =
      0;  ///< negative weights beyond that set to 0, a failure of the flips; 0 unless something is wrong
  double largest_clamped = 0;  ///< largest clamped |weight| over the larger diagonal of its row and column

  int threads = 1;                ///< threads that the build used
  std::vector<StageCost> stages;  ///< in the order of the build
};

/// Calls visit(name, member) for each member of a Report except `stages`: numbers, a bool, and the array `votes`.
/// Reports are written, read and shown by this one list.
/// @param report a Report or a const Report
/// @param visit callable with (const char*, member&)
template <class AnyReport, class Visit>
void visitNumbers(AnyReport& report, const Visit& visit) {
  visit("points", report.points);
  visit("active", report.active);
  visit("not_finite", report.not_finite);
  visit("coincident", report.coincident);
  visit("isolated", report.isolated);
  visit("rim_points", report.rim_points);
  visit("jump_points", report.jump_points);
  visit("lost_points", report.lost_points);
  visit("neighbors", report.neighbors);
  visit("neighbors_clamped", report.neighbors_clamped);
  visit("rejected_normals", report.rejected_normals);
  visit("rejected_neighbors", report.rejected_neighbors);
  visit("sparse_share", report.sparse_share);
  visit("unplaced", report.unplaced);
  visit("cut_neighbors", report.cut_neighbors);
  visit("grown_neighborhoods", report.grown_neighborhoods);
  visit("split_neighborhoods", report.split_neighborhoods);
  visit("isolated_by_sheets", report.isolated_by_sheets);
  visit("thick_neighborhoods", report.thick_neighborhoods);
  visit("outliers", report.outliers);
  visit("denoised", report.denoised);
  visit("noise", report.noise);
  visit("grown_stars", report.grown_stars);
  visit("closed_stars", report.closed_stars);
  visit("open_stars", report.open_stars);
  visit("dropped_triangles", report.dropped_triangles);
  visit("settled_diagonals", report.settled_diagonals);
  visit("votes", report.votes);
  visit("repeated_vertex_triangles", report.repeated_vertex_triangles);
  visit("not_finite_triangles", report.not_finite_triangles);
  visit("boundary_edges", report.boundary_edges);
  visit("nonmanifold_edges", report.nonmanifold_edges);
  visit("triangles", report.triangles);
  visit("mean_edge", report.mean_edge);
  visit("mean_squared_edge", report.mean_squared_edge);
  visit("lengthened_edges", report.lengthened_edges);
  visit("area_added", report.area_added);
  visit("degenerate_faces", report.degenerate_faces);
  visit("flips", report.flips);
  visit("flip_failures", report.flip_failures);
  visit("area", report.area);
  visit("cover_area", report.cover_area);
  visit("star_masses", report.star_masses);
  visit("nonzeros", report.nonzeros);
  visit("components", report.components);
  visit("clamped_weights", report.clamped_weights);
  visit("clamped_large", report.clamped_large);
  visit("largest_clamped", report.largest_clamped);
  visit("threads", report.threads);
}

/// Warnings that a user should see after a build, one sentence each; empty if all is well. The command prints them, and
/// so do Python and PCL.
std::vector<std::string> warnings(const Report& report);

}  // namespace tufted
