#pragma once

#include "operator.h"
#include "tufted/solver.h"
#include "tufted/spectrum.h"

/// Puts what was done into report.json, as its member "report", and into the summary.
void addReport(const tufted::SolveReport& report, Results& results);
void addReport(const tufted::SpectrumReport& report, Results& results);
