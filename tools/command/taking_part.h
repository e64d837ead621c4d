#pragma once

#include <vector>

#include "operator.h"

// Points that the user names, and which lie on no component of the Laplacian.

/// Says in the results which of the points named are left out, and why: by a warning, a line of the summary, and
/// `left_out` in the report.
/// @param others whether something else is named that may take part
/// @throws InvalidInput where nothing is left
void noteLeftOut(const std::vector<int>& points, const Operator& source, Results& results, bool others = false);

/// @throws InvalidInput for a point that takes no part, naming it and why
void requireTakingPart(const std::vector<int>& points, const Operator& source);
