#include "suggestion.h"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace {

std::string withoutDashes(const std::string& word) {
  std::string letters = word.substr(std::min(word.find_first_not_of('-'), word.size()));
  std::transform(letters.begin(), letters.end(), letters.begin(), [](unsigned char c) { return std::tolower(c); });
  return letters;
}

/// The least number of letters to insert, delete, replace or swap with the next that turns one word into the other.
std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    next[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      next[j] = std::min({row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        next[j] = std::min(next[j], before[j - 2] + 1);
    }
    before = row;
    row = next;
  }
  return row[b.size()];
}

/// The distance of a word from a known one: editDistance(), but 1 if one is a prefix of the other.
std::size_t distanceOf(const std::string& word, const std::string& known) {
  const std::size_t shorter = std::min(word.size(), known.size());
  const bool is_part = shorter > 2 && word.compare(0, shorter, known, 0, shorter) == 0;
  const std::size_t distance = editDistance(word, known);
  return is_part ? std::min<std::size_t>(distance, 1) : distance;
}

}  // namespace

std::string didYouMean(const std::string& word, const std::vector<std::string>& known) {
  const std::string typed = withoutDashes(word);
  const std::string* nearest = nullptr;
  // One letter in three may be wrong, in short words one.
  std::size_t least = std::max<std::size_t>(typed.size() + 1, 3) / 3 + 1;
  for (const std::string& candidate : known) {
    const std::string letters = withoutDashes(candidate);
    const std::size_t distance = distanceOf(typed, letters);
    if (distance >= least || distance >= std::max(typed.size(), letters.size())) continue;
    least = distance;
    nearest = &candidate;
  }
  return nearest == nullptr ? "" : "; did you mean `" + *nearest + "`?";
}

std::string joined(const std::vector<std::string>& words, const std::string& separator) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : separator) + word;
  return all;
}

std::string noneOf(const std::string& word, const std::vector<std::string>& known, const std::string& separator) {
  return word + " is none of " + joined(known, separator) + didYouMean(word, known);
}
