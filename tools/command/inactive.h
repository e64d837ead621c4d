#pragma once

#include <string>

#include "progress_bar.h"
#include "tufted/laplacian.h"

// Messages about a Laplacian in which no point takes part, so that L and M are zero.

/// How many points have which status, if no point is active; otherwise an empty string.
std::string nothingActive(const tufted::Laplacian& laplacian);

/// Writes a line to stderr, in place of the bar.
void warn(ProgressBar& bar, const std::string& line);
