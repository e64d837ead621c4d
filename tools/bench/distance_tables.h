#pragma once

// Tables of distances and paths against exact ones, in Markdown.

namespace tufted::bench {

void printMeshes();       ///< distances on CGAL's meshes
void printPaths();        ///< paths on CGAL's meshes and on spheres
void printNonmanifold();  ///< distances on the surface of the paper's Figure 16
void printSphere();       ///< distances on clouds of the sphere
void printTorus();        ///< distances on clouds of a torus
void printSymmetry();     ///< symmetry and slopes of distances, and points not reached
void printQuery();        ///< times of queries

}  // namespace tufted::bench
