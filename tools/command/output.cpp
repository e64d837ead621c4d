#include "output.h"

#include <CLI/CLI.hpp>
#include <system_error>

#include "options.h"
#include "tufted/errors.h"
#include "tufted/io/write.h"

void addOut(CLI::App& command, std::filesystem::path& out) {
  command.add_option("-o,--out", out, "Directory for the results, made if missing")
      ->required()
      ->check(notEmpty)
      ->type_name("DIR");
}

void checkOutput(const Input& input, const std::filesystem::path& out, const std::vector<std::string>& files) {
  std::error_code error;
  for (const std::string& name : files)
    if (!input.isStandardInput() && std::filesystem::equivalent(input.file, out / name, error))
      throw tufted::InvalidInput(input.name() + ": is the input, and --out " + out.string() + " would overwrite it");
  tufted::checkWritable(out, files);
}
