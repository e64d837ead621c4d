#pragma once

#include <string>
#include <vector>

/// A file that no reader may take.
struct Malformed {
  std::string name;
  std::string bytes;
  std::string reason;  ///< a part of the message
};

/// A small file of a format that states how much it holds, so that every shorter one is wrong.
struct WellFormed {
  std::string name;
  std::string bytes;
};

std::vector<Malformed> malformedFiles();
std::vector<WellFormed> wellFormedFiles();
