#pragma once

// Tables of distances and paths against exact ones, in Markdown.

namespace tufted::bench {

void printMeshes();       ///< CGAL's meshes
void printPaths();        ///< paths on CGAL's meshes and on spheres
void printNonmanifold();  ///< the paper's Figure 16
void printSphere();       ///< clouds of the sphere
void printTorus();        ///< clouds of a torus
void printSymmetry();     ///< symmetry and slopes of distances, and points not reached
void printLogMaps();      ///< lines that follow logarithmic maps
void printSigned();       ///< signed distances from circles, and on real shapes
void printQuery();        ///< times of queries
void printPeers();        ///< times of CGAL beside those of tools/time_methods.py

}  // namespace tufted::bench
