#pragma once

#include <string>
#include <vector>

/// Names the word that was probably meant: "; did you mean `scan`?", or an empty string where none is near.
/// @param word as it was typed; dashes in front do not count, nor does upper case
/// @param known the words that there are
std::string didYouMean(const std::string& word, const std::vector<std::string>& known);
