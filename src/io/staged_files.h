#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/output_file.h"

namespace tufted::io {

/// The files of one result. Each is written under a temporary name in the directory it will stay in; commit() gives
/// all of them their names. Without it they are removed, and the directories that were made for them as well.
class StagedFiles {
 public:
  /// Makes `dir` with its parents where missing. @throws IoError
  explicit StagedFiles(const std::filesystem::path& dir);
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  /// The temporary path under which to write the file `name`, and the path that it will have.
  OutputPath stage(const std::string& name);
  /// @throws IoError if a file cannot be renamed
  void commit();

 private:
  /// Removes the directories that were made and are empty.
  void removeMade();

  std::filesystem::path dir_;
  std::vector<std::filesystem::path> made_;  ///< directories, the outermost first
  std::vector<OutputPath> files_;
};

}  // namespace tufted::io
