#include "io/file_text.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

#include "io/errors.h"

namespace tufted::io {
namespace {

std::size_t fileSize(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) refuse(path, "no such file");
  if (error) refuse(path, "cannot read: " + error.message());
  if (std::filesystem::is_directory(status)) refuse(path, "is a directory");
  if (!std::filesystem::is_regular_file(status)) refuse(path, "is not a regular file");
  const auto size = std::filesystem::file_size(path, error);
  if (error) refuse(path, "cannot read: " + error.message());
  if (size == 0) refuse(path, "is empty");
  return size;
}

}  // namespace

std::string readBytes(const std::filesystem::path& path) {
  std::string bytes(fileSize(path), '\0');
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) refuseErrno(path, "read", errno);
  const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), file.get());
  if (count < bytes.size() && std::ferror(file.get())) refuseErrno(path, "read", errno);
  bytes.resize(count);
  return bytes;
}

MappedFile::MappedFile(const std::filesystem::path& path) {
  std::error_code error;
  // A pipe must not be opened: its writer would fail when it is closed again.
  if (!std::filesystem::is_regular_file(path, error)) return;
  const int file = ::open(path.c_str(), O_RDONLY);
  struct stat status = {};
  if (file < 0) return;
  if (fstat(file, &status) == 0 && status.st_size > 0) {
    size_ = static_cast<std::size_t>(status.st_size);
    for (std::size_t count = size_; count > 0; count /= 4) {
      void* const begin = mmap(nullptr, count, PROT_READ, MAP_PRIVATE, file, 0);
      if (begin == MAP_FAILED) continue;
      bytes_ = {static_cast<const char*>(begin), count};
      break;
    }
  }
  ::close(file);
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) munmap(const_cast<char*>(bytes_.data()), bytes_.size());
}

}  // namespace tufted::io
