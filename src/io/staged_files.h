#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/output_file.h"

namespace tufted::io {

/// The files of one result, which appear together. Each is written in a hidden folder, DIR/.tufted-XXXXXX, inside the
/// directory DIR it will stay in; commit() gives all of them their names, or none. Without it they are removed, with
/// the hidden folder and the directories that were made for them. Other files in DIR are never touched.
class StagedFiles {
 public:
  /// Makes `dir` with its parents where missing, and the hidden folder.
  /// @throws IoError
  explicit StagedFiles(const std::filesystem::path& dir);
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  /// The path in the hidden folder under which to write the file `name`, and the path that it will have.
  /// @throws IoError where a directory, a link, a device or a pipe has that name
  OutputPath stage(const std::string& name);

  /// The names of all files so far, in their order.
  std::vector<std::string> names() const;

  /// Brings the files to the disk, then renames them one after the other, while every other process that commits to
  /// `dir` waits. What had their names is kept in the hidden folder meanwhile, under old/, and is put back if a step
  /// fails. The last file is to say which the others are: no file has its name while they are renamed. A process that
  /// is killed between two renames so leaves files that nobody takes for a result, and the hidden folder, so nothing is
  /// lost; a hidden folder without old/ is of no use.
  /// @throws IoError
  void commit();

 private:
  struct File {
    OutputPath path;
    bool has_old = false;    ///< whether a former file of that name is kept
    bool is_placed = false;  ///< whether the new file has its name
  };

  /// Makes `dir_` with its parents.
  /// @param may_vanish gives false where another process has just removed one of them, otherwise that is an error
  bool makeDirectory(bool may_vanish);
  /// Makes the hidden folder as well.
  bool makeHiddenFolder(bool may_vanish);
  void keepOld(File& file);
  static void removeName(const File& file);
  void place(File& file);
  std::filesystem::path oldOf(const File& file) const { return old_ / file.path.shown.filename(); }
  /// @returns whether `dir_` is again as it was before keepOld() and place()
  bool putBack();
  /// Brings the names of the directories made to the disk.
  void syncParents() const;
  void removeHiddenFolder();
  /// Removes the directories that were made and are empty.
  void removeMade();

  std::filesystem::path dir_;
  std::filesystem::path hidden_;
  std::filesystem::path old_;                ///< folder in the hidden one for the former files of these names
  std::vector<std::filesystem::path> made_;  ///< directories, the outermost first
  std::vector<File> files_;
};

}  // namespace tufted::io
