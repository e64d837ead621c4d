#pragma once

// Tables of distances and paths against exact ones, in Markdown.

namespace tufted::bench {

void printMeshes();       ///< CGAL's meshes
void printPaths();        ///< paths on them and on spheres
void printNonmanifold();  ///< the paper's Figure 16
void printSphere();       ///< clouds of the sphere
void printTorus();        ///< clouds of a torus
void printSymmetry();     ///< there and back, slopes, and what is reached, by any surface
void printQuery();        ///< what a query costs

}  // namespace tufted::bench
