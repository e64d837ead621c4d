#pragma once

#include <nlohmann/json_fwd.hpp>

#include "tufted/spectrum.h"

/// For report.json.
nlohmann::ordered_json reportOf(const tufted::SpectrumReport& report);

/// Lines of the summary.
void printSpectrumReport(const tufted::SpectrumReport& report);
