#pragma once

#include <cstdint>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/options.h"

namespace tufted {

/// Labels the connected components of L, as in Laplacian::component, from L, status and representative alone.
/// @return N labels, 0 for the component of the most active points; -1 at isolated and non-finite points
/// @throws InvalidInput for arrays of the wrong size
std::vector<int> componentLabels(const Laplacian& laplacian);

/// Counts the points of each component, coincident ones included.
/// @param labels N, as from componentLabels(); negative ones are skipped
/// @return one size per component, in the order of the labels
std::vector<std::int64_t> componentSizes(const std::vector<int>& labels);

/// Restricts a Laplacian to some of its components, which stay in order. Points of other components become isolated:
/// their rows, masses and boundary are cleared. Of the cover, connected parts with a point of the components are kept.
/// @param components labels of componentLabels(), in any order; repeated ones count once
/// @return a Laplacian of the same N points
/// @throws InvalidInput for arrays of the wrong size or a label that no component has
/// @throws Cancelled when `progress` returns false
Laplacian restrictedTo(const Laplacian& laplacian, const std::vector<int>& components, const Progress& progress = {});

}  // namespace tufted
