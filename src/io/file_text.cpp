#include "io/file_text.h"

#include <cerrno>
#include <cstdio>
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

InputFile::InputFile(const std::filesystem::path& path)
    : path_(path), size_(fileSize(path)), file_(std::fopen(path.c_str(), "rb"), &std::fclose) {
  if (!file_) refuseErrno(path, "read", errno);
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);  // every read sees the file as it is
}

void InputFile::read(std::size_t begin, std::size_t count, std::string& bytes) const {
  const std::size_t before = bytes.size();
  bytes.resize(before + count);
  if (::fseeko(file_.get(), static_cast<off_t>(begin), SEEK_SET) != 0) refuseErrno(path_, "read", errno);
  const std::size_t got = std::fread(bytes.data() + before, 1, count, file_.get());
  if (got < count && std::ferror(file_.get()) != 0) refuseErrno(path_, "read", errno);
  if (got < count) refuseByte(path_, begin + got, "the file ends there, and was longer when it was opened");
}

std::string readBytes(const std::filesystem::path& path) {
  const InputFile file(path);
  std::string bytes;
  file.read(0, file.size(), bytes);
  return bytes;
}

}  // namespace tufted::io
