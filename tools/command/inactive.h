#pragma once

#include <string>

#include "progress_bar.h"
#include "tufted/laplacian.h"

// What commands say of a Laplacian in which no point takes part, so that L and M are zero.

/// What became of the points where none is active; an empty string where one is.
std::string nothingActive(const tufted::Laplacian& laplacian);

/// Writes a line to stderr, in place of the bar.
void warn(ProgressBar& bar, const std::string& line);
