#pragma once

#include "tufted/report.h"

namespace tufted::python {

/// Calls visit(name, member) for the numbers of a Report; `votes` and `stages` are not among them.
template <class AnyReport, class Visit>
void visitNumbers(AnyReport& report, const Visit& visit) {
#define TUFTED_VISIT(member) visit(#member, report.member)
  TUFTED_VISIT(points);
  TUFTED_VISIT(active);
  TUFTED_VISIT(not_finite);
  TUFTED_VISIT(coincident);
  TUFTED_VISIT(isolated);
  TUFTED_VISIT(rim_points);
  TUFTED_VISIT(jump_points);
  TUFTED_VISIT(lost_points);
  TUFTED_VISIT(neighbors);
  TUFTED_VISIT(neighbors_clamped);
  TUFTED_VISIT(rejected_normals);
  TUFTED_VISIT(rejected_neighbors);
  TUFTED_VISIT(unplaced);
  TUFTED_VISIT(cut_neighbors);
  TUFTED_VISIT(grown_neighborhoods);
  TUFTED_VISIT(split_neighborhoods);
  TUFTED_VISIT(isolated_by_sheets);
  TUFTED_VISIT(outliers);
  TUFTED_VISIT(denoised);
  TUFTED_VISIT(noise);
  TUFTED_VISIT(grown_stars);
  TUFTED_VISIT(closed_stars);
  TUFTED_VISIT(open_stars);
  TUFTED_VISIT(dropped_triangles);
  TUFTED_VISIT(repeated_vertex_triangles);
  TUFTED_VISIT(not_finite_triangles);
  TUFTED_VISIT(boundary_edges);
  TUFTED_VISIT(nonmanifold_edges);
  TUFTED_VISIT(triangles);
  TUFTED_VISIT(mean_edge);
  TUFTED_VISIT(mean_squared_edge);
  TUFTED_VISIT(mollify_length);
  TUFTED_VISIT(mollify_area);
  TUFTED_VISIT(degenerate_faces);
  TUFTED_VISIT(flips);
  TUFTED_VISIT(flip_failures);
  TUFTED_VISIT(area);
  TUFTED_VISIT(cover_area);
  TUFTED_VISIT(star_masses);
  TUFTED_VISIT(cover_masses);
  TUFTED_VISIT(bounded_masses);
  TUFTED_VISIT(nonzeros);
  TUFTED_VISIT(components);
  TUFTED_VISIT(clamped_weights);
  TUFTED_VISIT(clamped_large);
  TUFTED_VISIT(largest_clamped);
  TUFTED_VISIT(threads);
#undef TUFTED_VISIT
}

}  // namespace tufted::python
