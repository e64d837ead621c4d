#pragma once

#include <string>
#include <vector>

/// Suggests the word that was probably meant: "; did you mean `scan`?", or an empty string if none is similar.
/// @param word the word typed; its case and leading dashes do not count
/// @param known all valid words
std::string didYouMean(const std::string& word, const std::vector<std::string>& known);

/// The words with `separator` between them.
std::string joined(const std::vector<std::string>& words, const std::string& separator = ", ");

/// The message for a word that is none of the known ones, which it lists.
std::string noneOf(const std::string& word, const std::vector<std::string>& known, const std::string& separator = ", ");
