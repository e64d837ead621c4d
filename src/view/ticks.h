#pragma once

#include <string>
#include <vector>

namespace tufted::view {

/// 1, 2 or 5 times a power of ten, so that about `count` steps fit into `span`; 0 if span is not positive.
double niceStep(double span, int count);

/// Round values for the marks of a scale, and their texts. If numbers would be long, texts show them divided by ten to
/// the power of `exponent`; if they differ only in their last digits, after `offset` is subtracted.
struct Ticks {
  std::vector<double> values;
  std::vector<std::string> texts;
  int exponent = 0;
  double offset = 0;
};
/// Marks of a linear scale.
/// @param low,high ends of the scale; equal ones give one mark
Ticks ticksOf(double low, double high);

/// Marks of a logarithmic scale: powers of ten, and on a short scale twice and five times these.
/// @param low,high logarithms to base 10 of the ends of the scale
/// @return marks whose values are logarithms too
Ticks logarithmicTicksOf(double low, double high);

/// An exponent in superscript digits, as in a legend's "x 10^-3".
std::string raised(int exponent);

}  // namespace tufted::view
