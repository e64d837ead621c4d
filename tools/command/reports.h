#pragma once

#include "operator.h"
#include "tufted/distance.h"
#include "tufted/solver.h"
#include "tufted/spectrum.h"
#include "tufted/vector_heat.h"

/// Adds a report to the summary and, as member "report", to report.json.
void addReport(const tufted::SolveReport& report, Results& results);
void addReport(const tufted::SpectrumReport& report, Results& results);
void addReport(const tufted::DistanceReport& report, const tufted::SolverReport& solver, Results& results);
void addReport(const tufted::VectorHeatReport& report, const tufted::SolverReport& solver, Results& results);
