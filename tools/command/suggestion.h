#pragma once

#include <string>
#include <vector>

/// Suggests the word that was probably meant: "; did you mean `scan`?", or an empty string if none is similar.
/// @param word the word typed; its case and leading dashes do not count
/// @param known all valid words
std::string didYouMean(const std::string& word, const std::vector<std::string>& known);
