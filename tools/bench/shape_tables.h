#pragma once

// Tables of maps to the plane and of moved points, in Markdown.

namespace tufted::bench {

void printMaps();             ///< conformal maps of half spheres and planes
void printDisks();            ///< harmonic maps of CGAL's meshes that are disks
void printMinimal();          ///< the catenoid
void printSmoothing();        ///< a noisy sphere
void printNoise();            ///< points moved out of noise
void printDepthImages();      ///< depth images by their pixels and by the tree
void printDenoisedImages();   ///< denoise() of the same views
void printDepthSpectra();     ///< eigenvalues of one of them
void printDepthImageSpeed();  ///< what they cost
void printHandles();          ///< edits of well and of badly triangulated solids, and of boolean results

void printWeights();  ///< bounded weights on slivers

}  // namespace tufted::bench
