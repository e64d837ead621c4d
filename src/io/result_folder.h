#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tufted::io {

/// The file in which every result describes itself.
inline constexpr const char* report_name = "report.json";

/// A folder of results. Only the files that report.json lists belong to the last result; others, whatever their names,
/// belong to an earlier result or are unrelated.
class ResultFolder {
 public:
  /// Reads report.json. @throws IoError if it cannot be read, or is no JSON object
  explicit ResultFolder(const std::filesystem::path& dir);

  const nlohmann::json& report() const { return report_; }
  std::filesystem::path reportPath() const { return dir_ / report_name; }
  /// Names of the files of the last result. @throws IoError if report.json has no list of files, as in older versions
  const std::vector<std::string>& files() const;
  /// Whether the last result has this file. @throws IoError as files()
  bool has(const std::string& name) const;
  /// The path of a file of the last result. @throws IoError if that has no file of this name, and as files()
  std::filesystem::path pathOf(const std::string& name) const;

 private:
  std::filesystem::path dir_;
  nlohmann::json report_;
  bool is_listed_ = false;
  std::vector<std::string> files_;
};

}  // namespace tufted::io
