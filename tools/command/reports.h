#pragma once

#include "operator.h"
#include "tufted/distance.h"
#include "tufted/solver.h"
#include "tufted/spectrum.h"
#include "tufted/vector_heat.h"

/// Adds the report of a solve to report.json, as its member "report", and to the summary.
void addReport(const tufted::SolveReport& report, Results& results);
/// Adds the report of a spectrum to report.json, as its member "report", and to the summary.
void addReport(const tufted::SpectrumReport& report, Results& results);
/// Adds the report of distances to report.json, as its member "report", and to the summary.
void addReport(const tufted::DistanceReport& report, const tufted::SolverReport& solver, Results& results);
/// Adds the report of the vector heat method to report.json, as its member "report", and to the summary.
void addReport(const tufted::VectorHeatReport& report, const tufted::SolverReport& solver, Results& results);
