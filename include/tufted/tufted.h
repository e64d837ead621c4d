#pragma once

// Everything in the core library. Files and the PCL filters have headers of their own (tufted/io, tufted/pcl).
#include "tufted/check.h"
#include "tufted/describe.h"
#include "tufted/distance.h"
#include "tufted/errors.h"
#include "tufted/intrinsic_triangulation.h"
#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/polygons.h"
#include "tufted/report.h"
#include "tufted/scan_structure.h"
#include "tufted/smoothing.h"
#include "tufted/solver.h"
#include "tufted/spectral.h"
#include "tufted/spectrum.h"
#include "tufted/types.h"
