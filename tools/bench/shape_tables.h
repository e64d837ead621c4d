#pragma once

// Tables about parameterisations and moved points, in Markdown.

namespace tufted::bench {

void printMaps();             ///< conformal maps of half spheres and planes
void printDisks();            ///< harmonic maps of CGAL's meshes that are disks
void printMinimal();          ///< the catenoid
void printSmoothing();        ///< a noisy sphere
void printNoise();            ///< denoised points
void printDepthImages();      ///< Laplacians of depth images, by pixels and by the tree
void printDenoisedImages();   ///< denoise() of depth images
void printDepthSpectra();     ///< eigenvalues of a depth image
void printDepthImageSpeed();  ///< time and memory of depth images
void printHandles();          ///< deformations of well and badly triangulated solids, and of boolean results

void printWeights();  ///< bounded biharmonic weights on slivers

}  // namespace tufted::bench
