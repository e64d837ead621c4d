#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/output_file.h"

namespace tufted::io {

/// The files of one result, which appear together or not at all. They are written into a hidden folder,
/// DIR/.tufted-XXXXXX, in their directory DIR, and commit() renames all of them. Without that call they are removed,
/// with the hidden folder and the directories that were made for them. Other files in DIR are never touched.
class StagedFiles {
 public:
  /// Makes `dir` and its parents if missing, and the hidden folder.
  /// @throws IoError naming the path
  explicit StagedFiles(const std::filesystem::path& dir);
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  /// Adds a file called `name`.
  /// @return the path in the hidden folder under which to write it, and the path that it will have
  /// @throws IoError if a directory, a link, a device or a pipe has that name
  OutputPath stage(const std::string& name);

  /// The names of all files added so far, in order.
  std::vector<std::string> names() const;

  /// Flushes the files to disk, then renames them one after the other, while other processes that commit to `dir` wait.
  /// Existing files of these names are kept in old/ in the hidden folder meanwhile, and put back if a step fails. The
  /// last file must be the one that lists the others, report.json: it is missing while they are renamed. So if the
  /// process is killed, the files do not look like a result, and old/ has those replaced. A hidden folder without old/
  /// can be deleted.
  /// @throws IoError naming the path
  void commit();

 private:
  struct File {
    OutputPath path;
    std::filesystem::path old = {};  ///< in old/, set by commit() before anything is renamed
    bool has_old = false;            ///< whether an existing file of that name was moved or linked to old/
    bool is_placed = false;          ///< whether the new file was renamed
  };

  /// Makes `dir_` with its parents.
  /// @param may_vanish whether to return false if another process has just removed one of them, instead of throwing
  bool makeDirectory(bool may_vanish);
  /// Makes the hidden folder as well.
  bool makeHiddenFolder(bool may_vanish);
  void keepOld(File& file);
  static void removeName(const File& file);
  void place(File& file);
  std::filesystem::path oldOf(const File& file) const { return old_ / file.path.shown.filename(); }
  /// Undoes keepOld() and place(). Returns false if a file could not be put back.
  bool putBack();
  /// Flushes the names of the directories that were made to disk.
  void syncParents() const;
  /// Takes no memory, because it is called when there is none left.
  void removeHiddenFolder() noexcept;
  /// Removes the directories that were made and are empty.
  void removeMade();

  std::filesystem::path dir_;
  std::filesystem::path hidden_;
  std::filesystem::path old_;                ///< old/ in the hidden folder, for the files that are replaced
  std::vector<std::filesystem::path> made_;  ///< directories that were made, the outermost first
  std::vector<File> files_;
};

}  // namespace tufted::io
