#include "io/npz_reader.h"

#include <cmath>

#include "io/errors.h"
#include "io/file_text.h"
#include "io/npy.h"

namespace tufted::io {

NpzReader::NpzReader(const std::filesystem::path& path) : path_(path), bytes_(readBytes(path)) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes_.data(), bytes_.size(), 0, &error);
  if (source != nullptr) archive_.reset(zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error));
  if (source != nullptr && !archive_) zip_source_free(source);
  zip_error_fini(&error);
  if (!archive_) refuse(path_, "is no archive of numpy");
}

std::string NpzReader::read(const std::string& name) const {
  zip_stat_t status;
  if (zip_stat(archive_.get(), (name + ".npy").c_str(), 0, &status) != 0 || (status.valid & ZIP_STAT_SIZE) == 0)
    refuse(path_, "has no array " + quote(name));
  // Deflate shrinks a thousandfold at best: what claims more is damaged, and not worth the memory.
  if (status.size / 2048 > bytes_.size()) refuse(path_, "the array " + quote(name) + " claims to be too large");
  std::string content(status.size, '\0');
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(zip_fopen_index(archive_.get(), status.index, 0),
                                                               &zip_fclose);
  if (!file || zip_fread(file.get(), content.data(), content.size()) != static_cast<zip_int64_t>(content.size()))
    refuse(path_, "the array " + quote(name) + " is damaged");
  return content;
}

std::vector<double> NpzReader::numbers(const std::string& name) const {
  const std::string bytes = read(name);
  return numbersOf(parseNpy(bytes, path_), path_);
}

std::vector<int> integersOf(const std::vector<double>& numbers, double least, double most,
                            const std::filesystem::path& shown) {
  std::vector<int> result(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!(numbers[i] >= least && numbers[i] <= most) || numbers[i] != std::floor(numbers[i]))
      refuse(shown, "value " + std::to_string(i) + " is none of those expected");
    result[i] = static_cast<int>(numbers[i]);
  }
  return result;
}

}  // namespace tufted::io
