#pragma once

#include <cstdint>

// Tables of the accuracy of the algorithms, in Markdown.

namespace tufted::bench {

constexpr std::uint64_t first_seed = 101, last_seed = 105;  ///< of samples; constants are chosen on 1 to 9

void printMeshes();           ///< CGAL's meshes
void printPaths();            ///< paths on CGAL's meshes and on spheres
void printNonmanifold();      ///< the paper's Figure 16
void printSphere();           ///< clouds of the sphere
void printTorus();            ///< clouds of a torus
void printSymmetry();         ///< symmetry and slopes of distances, and points not reached
void printLines();            ///< traced lines and isolines beside circles
void printLogMaps();          ///< lines that follow logarithmic maps
void printSigned();           ///< signed distances from circles, and on real shapes
void printQuery();            ///< times of queries
void printPeers();            ///< times of CGAL beside those of tools/time_methods.py
void printMaps();             ///< conformal maps of half spheres and planes
void printDisks();            ///< harmonic maps of CGAL's meshes that are disks
void printMinimal();          ///< the catenoid
void printSmoothing();        ///< a noisy sphere
void printNoise();            ///< denoised points
void printDepthImages();      ///< Laplacians of depth images, by pixels and by the tree
void printDenoisedImages();   ///< denoise() of depth images
void printDepthSpectra();     ///< eigenvalues of a depth image
void printDepthCurvatures();  ///< curvatures of every pixel, and of every second and third row and column
void printDepthImageSpeed();  ///< time and memory of depth images
void printHandles();          ///< deformations of well and badly triangulated solids, and of boolean results
void printWeights();          ///< bounded biharmonic weights on slivers

}  // namespace tufted::bench
