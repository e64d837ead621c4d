#pragma once

#include <filesystem>
#include <string>
#include <vector>

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

  /// The temporary path under which to write the file `name`.
  std::filesystem::path stage(const std::string& name);
  /// The path that the file `name` will have.
  std::filesystem::path finished(const std::string& name) const { return dir_ / name; }
  /// @throws IoError if a file cannot be renamed
  void commit();

 private:
  /// Removes the directories that were made and are empty.
  void removeMade();

  struct File {
    std::filesystem::path temporary, finished;
  };

  std::filesystem::path dir_;
  std::vector<std::filesystem::path> made_;  ///< directories, the outermost first
  std::vector<File> files_;
};

}  // namespace tufted::io
