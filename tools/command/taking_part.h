#pragma once

#include <vector>

#include "operator.h"

// Points that the user names although they take no part.

/// Notes in the results which of the named points take no part, and why: a warning, a line of the summary, and
/// `left_out` in the report.
/// @param others whether the user also named something else that may take part
/// @throws InvalidInput if none of the points takes part and there are no others
void noteLeftOut(const std::vector<int>& points, const Operator& source, Results& results, bool others = false);

/// @throws InvalidInput for a point that takes no part, naming it and why
void requireTakingPart(const std::vector<int>& points, const Operator& source);
