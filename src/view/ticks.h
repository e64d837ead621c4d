#pragma once

#include <string>
#include <vector>

namespace tufted::view {

/// 1, 2 or 5 times a power of ten, such that about `count` steps fit into `span`; 0 where span is not positive.
double niceStep(double span, int count);

/// Round values for the marks of a scale, and their texts. Where numbers would be long, all are divided by ten to the
/// power of `exponent`; where they differ in their last digits only, `offset` has been subtracted before.
struct Ticks {
  std::vector<double> values;
  std::vector<std::string> texts;
  int exponent = 0;
  double offset = 0;
};
/// @param low, high the ends of the scale; equal ones give one mark
Ticks ticksOf(double low, double high);

/// Marks of a logarithmic scale: powers of ten, and on a short scale their double and fivefold.
/// @param low, high the logarithms to base 10 of the ends of the scale; so are the values of the marks
Ticks logarithmicTicksOf(double low, double high);

/// An exponent in raised digits of UTF-8, as in a legend's "x 10^-3".
std::string raised(int exponent);

}  // namespace tufted::view
