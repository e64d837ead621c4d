#include "io/staged_files.h"

#include <unistd.h>

#include <atomic>
#include <system_error>

#include "io/errors.h"

namespace tufted::io {

StagedFiles::StagedFiles(const std::filesystem::path& dir) : dir_(dir) {
  std::error_code error;
  // Not what a link points to: a link that leads nowhere is not ours to remove.
  for (auto missing = std::filesystem::absolute(dir_, error);
       std::filesystem::symlink_status(missing, error).type() == std::filesystem::file_type::not_found &&
       missing.has_relative_path();
       missing = missing.parent_path())
    made_.insert(made_.begin(), missing);
  std::filesystem::create_directories(dir_, error);
  if (error) {
    removeMade();  // some parents may be there by now
    refuse(dir_, "cannot make the directory: " + error.message());
  }
  if (!std::filesystem::is_directory(dir_, error)) refuse(dir_, "is not a directory");
}

StagedFiles::~StagedFiles() {
  std::error_code ignored;
  for (const OutputPath& file : files_) std::filesystem::remove(file.path, ignored);
  removeMade();
}

void StagedFiles::removeMade() {
  std::error_code ignored;
  for (auto made = made_.rbegin(); made != made_.rend(); ++made) std::filesystem::remove(*made, ignored);
}

OutputPath StagedFiles::stage(const std::string& name) {
  static std::atomic<unsigned> counter = 0;
  const std::string suffix = ".tmp-" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
  files_.push_back({dir_ / ("." + name + suffix), dir_ / name});
  return files_.back();
}

void StagedFiles::commit() {
  std::error_code error;
  for (const OutputPath& file : files_)
    if (std::filesystem::is_directory(file.shown, error)) refuse(file.shown, "cannot write: is a directory");
  for (const OutputPath& file : files_) {
    std::filesystem::rename(file.path, file.shown, error);
    if (error) refuse(file.shown, "cannot write: " + error.message());
  }
  files_.clear();
  made_.clear();
}

}  // namespace tufted::io
