#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tufted::io {

/// The name under which every result describes itself.
inline constexpr const char* report_name = "report.json";

/// A folder of results as its report.json describes it. Only the files that this lists belong to the last result; any
/// other is of an earlier one, or somebody else's, whatever its name.
class ResultFolder {
 public:
  /// @throws IoError for a report.json that cannot be read, or holds no object
  explicit ResultFolder(const std::filesystem::path& dir);

  const nlohmann::json& report() const { return report_; }
  std::filesystem::path reportPath() const { return dir_ / report_name; }
  /// @throws IoError for a report that lists no files, as those of results before there was such a list
  const std::vector<std::string>& files() const;
  /// Whether the last result has this file. @throws IoError as files()
  bool has(const std::string& name) const;
  /// The path of a file of the last result. @throws IoError if it has none of this name, and as files()
  std::filesystem::path pathOf(const std::string& name) const;

 private:
  std::filesystem::path dir_;
  nlohmann::json report_;
  bool is_listed_ = false;
  std::vector<std::string> files_;
};

}  // namespace tufted::io
