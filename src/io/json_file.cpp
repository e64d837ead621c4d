#include "io/json_file.h"

#include <string>

#include "io/errors.h"
#include "io/file_text.h"

nlohmann::json tufted::io::readJson(const std::filesystem::path& path) {
  using Json = nlohmann::json;
  // Most levels of nesting: our own files have four, and deep recursion would crash the process.
  constexpr int most = 32;
  const auto check = [&path](int depth, Json::parse_event_t, const Json&) {
    if (depth > most) refuse(path, "is nested deeper than " + std::to_string(most) + " levels");
    return true;
  };
  return Json::parse(readBytes(path), check, false);
}
