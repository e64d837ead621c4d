#pragma once

#include "tufted/io/read.h"
#include "tufted/laplacian.h"

/// A right triangle at UTM coordinates (legs 2, area 2) with its cotan Laplacian, and a fourth point that is missing.
tufted::Geometry sampleGeometry();
tufted::Laplacian sampleLaplacian();
