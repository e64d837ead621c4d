#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace tufted::io {

/// Throw IoError: "path: reason", "path: line 12: reason", "path: byte 120: reason".
[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason);
[[noreturn]] void refuseLine(const std::filesystem::path& path, std::int64_t line, const std::string& reason);
[[noreturn]] void refuseByte(const std::filesystem::path& path, std::size_t byte, const std::string& reason);
/// Throws IoError: "path: cannot <action>: <what errno says>".
[[noreturn]] void refuseErrno(const std::filesystem::path& path, const std::string& action, int error);

/// Text of a file for an error message: quoted, printable, at most 32 characters.
std::string quote(std::string_view text);

}  // namespace tufted::io
