#pragma once

#include "operator.h"
#include "tufted/distance.h"
#include "tufted/solver.h"
#include "tufted/spectrum.h"

// Each puts what was done into report.json, as its member "report", and into the summary.

void addReport(const tufted::SolveReport& report, Results& results);
void addReport(const tufted::SpectrumReport& report, Results& results);
void addReport(const tufted::DistanceReport& report, const tufted::SolverReport& solver, Results& results);
