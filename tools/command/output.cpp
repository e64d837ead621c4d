#include "output.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "options.h"
#include "tufted/errors.h"
#include "tufted/io/write.h"

void addOut(CLI::App& command, std::filesystem::path& out) {
  addText(command, "-o,--out DIR", out, "Folder for the results, created if missing")->required();
}

void addFormats(CLI::App& command, std::vector<tufted::Format>& target,
                const std::map<std::string, tufted::Format>& formats, const std::string& help) {
  std::vector<std::string> known = namesIn(formats);
  known.emplace_back("none");
  const auto check = [known](const std::string& key) { return refuseName(key, known); };
  const auto set = [&target, formats](const std::vector<std::string>& keys) {
    target.clear();
    if (keys.size() == 1 && keys[0] == "none") return;
    for (const std::string& key : keys) {
      if (key == "none") throw CLI::ValidationError("--format", "none stands alone");
      target.push_back(formats.at(key));
    }
  };
  addList(command, "--format", help, check, set)->type_name("LIST");
}

void addCopies(CLI::App& command, std::vector<tufted::Format>& target) {
  addFormats(command, target,
             {{"ply", tufted::Format::ply}, {"pcd", tufted::Format::pcd}, {"las", tufted::Format::las}},
             "Formats of the copy of the points with the results, separated by commas: ply, pcd, las, or none (ply)");
}

void requireLas(const tufted::Geometry& geometry, const std::vector<tufted::Format>& formats, const std::string& name,
                const std::vector<ShownField>& fields) {
  if (std::find(formats.begin(), formats.end(), tufted::Format::las) == formats.end()) return;
  if (!geometry.points.allFinite())
    throw tufted::IoError(name + ": has points that are not finite, which points.las cannot hold; --format ply can");
  std::vector<tufted::ResultArray> arrays;
  for (const ShownField& field : fields)
    arrays.push_back({field.name, Eigen::MatrixXd(0, std::max(field.columns, field.least))});
  tufted::checkLas(geometry, arrays);
}

void checkOutput(const std::vector<NamedInput>& inputs, const std::filesystem::path& out,
                 const std::vector<std::string>& files) {
  const std::string option = "--out " + out.string();
  refuseOverwriting(option, out, inputs);
  for (const std::string& name : files) refuseOverwriting(option, out / name, inputs);
  refuseOverwriting(option, out / "file_row.npy", inputs);  // written if points are chosen
  tufted::checkWritable(out, files);
}
