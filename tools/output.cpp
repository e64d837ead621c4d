#include "output.h"

#include <CLI/CLI.hpp>
#include <system_error>

#include "options.h"
#include "tufted/errors.h"

void addOut(CLI::App& command, std::filesystem::path& out) {
  command.add_option("--out", out, "Directory for the results, made if missing")
      ->required()
      ->check(notEmpty)
      ->type_name("DIR");
}

void checkOutput(const Input& input, const std::filesystem::path& out, const std::vector<std::string>& files) {
  std::error_code error;
  for (const std::string& name : files)
    if (!input.isStandardInput() && std::filesystem::equivalent(input.file, out / name, error))
      throw tufted::InvalidInput(input.name() + ": is the input, and --out " + out.string() + " would overwrite it");
  const auto status = std::filesystem::status(out, error);
  if (status.type() == std::filesystem::file_type::not_found) return;
  if (error) throw tufted::IoError(out.string() + ": " + error.message());
  if (!std::filesystem::is_directory(status)) throw tufted::IoError(out.string() + ": is not a directory");
}
