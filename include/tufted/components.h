#pragma once

#include <cstdint>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/options.h"

namespace tufted {

/// The connected component of each point, as Laplacian::component, from L, status and representative alone.
/// @return N labels
/// @throws InvalidInput for arrays of the wrong size
std::vector<int> componentLabels(const Laplacian& laplacian);

/// The number of points of each component, coincident ones counted, the component 0 first.
/// @param labels N, as componentLabels() gives them
std::vector<std::int64_t> componentSizes(const std::vector<int>& labels);

/// The Laplacian of some components alone. All other points are isolated: they have no row, no mass and no boundary.
/// The components that stay keep their order. Of the cover those triangles stay that lie, or are joined to others that
/// lie, in one of the components.
/// @param components their labels, each once or more
/// @throws InvalidInput for arrays of the wrong size or a label that no component has
/// @throws Cancelled when `progress` returns false
Laplacian restrictedTo(const Laplacian& laplacian, const std::vector<int>& components, const Progress& progress = {});

}  // namespace tufted
