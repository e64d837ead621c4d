// The ZIP archives of .npz files: libzip writes what we read, and reads what we write.
#include <gtest/gtest.h>
#include <zip.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <vector>

#include "io/npz_archive.h"
#include "io/zip_reader.h"
#include "temporary_dir.h"

namespace zip_test {
namespace {

using Archive = std::unique_ptr<zip_t, decltype(&zip_discard)>;

/// Numbers that deflate can shrink, but not to nothing.
std::string content(std::size_t size) {
  std::string bytes(size, '\0');
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>((i * i / 7) % 11);
  return bytes;
}

std::string bytesOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A file of an archive, unpacked in pieces; nullopt if the reader takes it for damaged.
std::optional<std::string> unpacked(const std::string& archive, const std::string& name) {
  const auto entries = tufted::io::readZipDirectory(archive);
  if (!entries || !entries->contains(name)) return {};
  const tufted::io::ZipEntry& entry = entries->at(name);
  tufted::io::ZipStream stream(entry);
  std::string bytes(entry.size, '\0');
  constexpr std::size_t piece = 777;
  for (std::size_t at = 0; at < bytes.size(); at += piece)
    if (!stream.read(bytes.data() + at, std::min(piece, bytes.size() - at))) return {};
  char beyond;
  EXPECT_FALSE(stream.read(&beyond, 1));
  return bytes;
}

std::string unpackedByLibzip(const std::filesystem::path& path, const std::string& name) {
  const Archive archive(zip_open(path.c_str(), ZIP_RDONLY | ZIP_CHECKCONS, nullptr), &zip_discard);
  zip_stat_t status;
  if (!archive || zip_stat(archive.get(), name.c_str(), 0, &status) != 0) return "not found";
  std::string bytes(status.size + 1, '\0');
  zip_file_t* const file = zip_fopen(archive.get(), name.c_str(), 0);
  bytes.resize(static_cast<std::size_t>(std::max<zip_int64_t>(zip_fread(file, bytes.data(), bytes.size()), 0)));
  return zip_fclose(file) == 0 ? bytes : "damaged";
}

TEST(Zip, FilesOfLibzipAreRead) {
  const TemporaryDir dir;
  for (const zip_int32_t method : {ZIP_CM_STORE, ZIP_CM_DEFLATE}) {
    const std::filesystem::path path = dir / ("by_libzip_" + std::to_string(method));
    const std::size_t sizes[] = {1, 776, 777, 100'000};
    Archive archive(zip_open(path.c_str(), ZIP_CREATE, nullptr), &zip_discard);
    std::vector<std::string> contents;
    for (const std::size_t size : sizes) contents.push_back(content(size));
    for (const std::string& bytes : contents) {
      zip_source_t* const source = zip_source_buffer(archive.get(), bytes.data(), bytes.size(), 0);
      const zip_int64_t index = zip_file_add(archive.get(), std::to_string(bytes.size()).c_str(), source, 0);
      zip_set_file_compression(archive.get(), static_cast<zip_uint64_t>(index), method, 0);
    }
    zip_set_archive_comment(archive.get(), "a comment at the end", 20);
    ASSERT_EQ(zip_close(archive.release()), 0);
    const std::string bytes = bytesOf(path);
    for (const std::size_t size : sizes) EXPECT_EQ(unpacked(bytes, std::to_string(size)), content(size)) << size;
    EXPECT_EQ(unpacked(bytes.substr(0, bytes.size() - 21), "777"), std::nullopt);
  }
}

TEST(Zip, LibzipReadsWhatIsWritten) {
  const TemporaryDir dir;
  const std::string values = content(8 * 12345);
  tufted::io::NpzArchive archive({dir / "a.npz", "a.npz"});
  archive.add("data.npy", "<f8", {12345}, values.data(), values.size());
  archive.add("none.npy", "<f8", {0}, nullptr, 0);
  archive.close();
  for (const std::string name : {"data.npy", "none.npy"})
    EXPECT_EQ(unpacked(bytesOf(dir / "a.npz"), name), unpackedByLibzip(dir / "a.npz", name));
  EXPECT_TRUE(unpackedByLibzip(dir / "a.npz", "data.npy").ends_with(values));
}

/// A number of `size` bytes, its lowest first.
std::string number(std::uint64_t value, std::size_t size) {
  std::string bytes(size, '\0');
  for (std::size_t i = 0; i < std::min<std::size_t>(size, 8); ++i) bytes[i] = static_cast<char>(value >> (8 * i));
  return bytes;
}

/// An archive of one stored file "a" per text, as zipfile of Python writes it.
std::string archiveOf(const std::vector<std::string>& files, std::uint64_t flags = 0, std::uint64_t method = 0) {
  std::string bytes, directory;
  for (const std::string& values : files) {
    const uLong checksum = crc32_z(0, reinterpret_cast<const Bytef*>(values.data()), values.size());
    const std::string what = number(20, 2) + number(flags, 2) + number(method, 2) + number(0, 4) + number(checksum, 4) +
                             number(values.size(), 4) + number(values.size(), 4) + number(1, 2) + number(0, 2);
    directory += "PK\1\2" + number(20, 2) + what + number(0, 10) + number(bytes.size(), 4) + "a";
    bytes += "PK\3\4" + what + "a" + values;
  }
  const std::string count = number(files.size(), 2);
  return bytes + directory + "PK\5\6" + number(0, 4) + count + count + number(directory.size(), 4) +
         number(bytes.size(), 4) + number(0, 2);
}

TEST(Zip, DamagedFilesAreNotRead) {
  const std::string archive = archiveOf({"values"});
  EXPECT_EQ(unpacked(archive, "a"), "values");
  std::string other = archive;
  other[31] = 'V';  // the first of the values, after the local header and the name
  EXPECT_EQ(unpacked(other, "a"), std::nullopt);
}

TEST(Zip, ArchivesThatOthersReadOtherwiseAreRefused) {
  const std::string first = archiveOf({"values"}), second = archiveOf({"others"});
  EXPECT_FALSE(tufted::io::readZipDirectory(archiveOf({"values", "others"})));  // two files with one name
  EXPECT_FALSE(tufted::io::readZipDirectory(first + second));  // offsets of the second lead into the first
}

TEST(Zip, EncryptedAndOtherwiseCompressedFilesAreListed) {
  constexpr std::uint64_t encrypted = 1, lzma = 14;
  for (const std::string& archive : {archiveOf({"values"}, encrypted), archiveOf({"values"}, 0, lzma)}) {
    const auto entries = tufted::io::readZipDirectory(archive);
    ASSERT_TRUE(entries && entries->contains("a"));
    EXPECT_FALSE(entries->at("a").is_readable);
  }
}

// Archives above 4 GB have numbers of eight bytes, and any other archive may have them.
TEST(Zip, NumbersOfEightBytesAreRead) {
  const TemporaryDir dir;
  const std::string values = content(5000), elsewhere = number(0xffffffff, 4), size = number(5000, 8);
  const std::string checksum = number(crc32_z(0, reinterpret_cast<const Bytef*>(values.data()), values.size()), 4);
  const std::string what = number(45, 2) + number(0, 8) + checksum + elsewhere + elsewhere + number(1, 2);
  std::string bytes = "PK\3\4" + what + number(20, 2) + "a" + number(1, 2) + number(16, 2) + size + size + values;
  const std::string directory = number(bytes.size(), 8);
  bytes += "PK\1\2" + number(45, 2) + what + number(28, 2) + number(0, 10) + elsewhere + "a" + number(1, 2) +
           number(24, 2) + size + size + number(0, 8);
  const std::string end = number(bytes.size(), 8), entries = number(1, 8) + number(1, 8);
  const std::string directory_size = number(bytes.size() - 5051, 8);
  bytes +=
      "PK\6\6" + number(44, 8) + number(45, 2) + number(45, 2) + number(0, 8) + entries + directory_size + directory;
  bytes += "PK\6\7" + number(0, 4) + end + number(1, 4);
  bytes += "PK\5\6" + number(0, 4) + number(1, 2) + number(1, 2) + elsewhere + elsewhere + number(0, 2);
  std::ofstream(dir / "large.zip", std::ios::binary) << bytes;
  EXPECT_EQ(unpackedByLibzip(dir / "large.zip", "a"), values);
  EXPECT_EQ(unpacked(bytes, "a"), values);
  // Whatever is cut off, nothing beyond the end is read.
  for (std::size_t bytes_left = 0; bytes_left < bytes.size(); ++bytes_left)
    EXPECT_EQ(unpacked(bytes.substr(0, bytes_left), "a"), std::nullopt) << bytes_left;
}

}  // namespace
}  // namespace zip_test
