#include "io/file_text.h"

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

}  // namespace tufted::io
