#pragma once

// What subcommands that use a Laplacian need: their common options, and how the user names points, values and spectra.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "eigenpairs.h"
#include "extent.h"
#include "moved_points.h"
#include "operator.h"
#include "options.h"
#include "oriented.h"
#include "pin_options.h"
#include "point_options.h"
#include "reports.h"
#include "signal_options.h"
#include "tufted/errors.h"
#include "warnings.h"
