#pragma once

#include <string>
#include <vector>

#include "tufted/laplacian.h"

/// What every Laplacian promises, whatever the input was. Tests only.
namespace tufted::guarantees {

/// One line per broken promise, which begins with its name and says how often and where first it is broken. Empty for
/// every result of pointCloudLaplacian and meshLaplacian with `keep_cover`.
/// @param points what the Laplacian was built from
std::vector<std::string> brokenGuarantees(const Laplacian& laplacian, const Points& points);

}  // namespace tufted::guarantees
