#include "time_step.h"

#include <CLI/CLI.hpp>
#include <cmath>

#include "extent.h"
#include "options.h"
#include "tufted/errors.h"

CLI::Option* addTimeStep(CLI::App& command, std::optional<double>& time_step, const std::string& text) {
  return addNumber(command, "--time-step T", time_step, 1e-4, 1e12, text);
}

void checkTimeStep(const std::optional<double>& time_step, double time, const Operator& source) {
  if (!time_step) return;
  constexpr double shortest = 0.01;  // least distance that heat spreads, in spacings
  const Extent extent = extentOf(source);
  const double length = std::sqrt(time);
  if (length >= shortest * extent.spacing && length <= extent.size) return;
  throw tufted::InvalidInput("--time-step " + numberText(*time_step) + ": heat goes " + numberText(length) + ", " +
                             (length > extent.size ? "beyond all points" : "less than a hundredth of the spacing") +
                             ": " + extent.text());
}
