#include "io/field_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <sstream>

namespace tufted::io {
namespace {

using PlainNames = std::map<std::string, std::string, std::less<>>;

const std::set<std::string, std::less<>> colors = {"red", "green", "blue"};

/// The letters and digits of a name in lower case, so that normal_x and NormalX compare equal. A colon before a final
/// digit is kept.
std::string lettersOf(std::string_view name) {
  std::string letters;
  for (std::size_t i = 0; i < name.size(); ++i)
    if (std::isalnum(static_cast<unsigned char>(name[i])) != 0 || (name[i] == ':' && i + 2 == name.size()))
      letters += name[i];
  return lower(letters);
}

void addAxes(PlainNames& names, const std::array<const char*, 3>& axes, const std::vector<std::string>& letters,
             const std::vector<std::string>& numbers) {
  for (std::size_t c = 0; c < 3; ++c) {
    const std::string axis(1, "xyz"[c]);
    for (const std::string& stem : letters) {
      names[stem + axis] = axes[c];
      names[axis + stem] = axes[c];
    }
    for (const std::string& stem : numbers) names[stem + ":" + std::to_string(c)] = axes[c];
  }
}

/// Maps lettersOf() of names by PCL, PDAL, CloudCompare, MeshLab, ParaView, VeloView and surveyors to ours. ParaView
/// and VeloView append a colon and a number to the values of one array.
PlainNames makeNames() {
  PlainNames names;
  std::istringstream own(
      "rgb rgba red green blue alpha intensity ring azimuth label classification gps_time return_number "
      "number_of_returns scan_direction edge_of_flight_line scan_angle_rank scan_angle scanner_channel "
      "user_data point_source_id synthetic key_point withheld overlap nir");
  for (std::string name; own >> name;) names[lettersOf(name)] = name;
  const std::vector<std::string> places = {"points", "pointsmxyz", "position", "positions", "coordinates", "xyz"};
  addAxes(names, {"x", "y", "z"}, {"", "pos", "position", "point", "points", "coord", "coordinate", "location"},
          places);
  addAxes(names, {"nx", "ny", "nz"}, {"n", "norm", "normal", "normals"}, {"normal", "normals"});
  std::istringstream others(  // pairs of another name and ours
      "easting x northing y elevation z altitude z height z i intensity laserid ring ringid ring "
      "scandirectionflag scan_direction scanchannel scanner_channel infrared nir r red g green b blue");
  for (std::string other, name; others >> other >> name;) names[other] = name;
  for (const std::string stem : {"points", "pointsmxyz"})  // names of newer ParaView versions
    for (std::size_t c = 0; c < 3; ++c) names[stem + std::to_string(c)] = std::string(1, "xyz"[c]);
  for (const std::string stem : {"diffuse", "color", "colour", "vertex"})
    for (const char* channel : {"red", "green", "blue", "alpha"}) names[stem + channel] = channel;
  for (const std::string stem : {"rgb", "rgba", "color", "colors", "colour", "colours"})
    for (std::size_t c = 0; c < 4; ++c)
      names[stem + ":" + std::to_string(c)] = std::array{"red", "green", "blue", "alpha"}[c];
  return names;
}

/// Our name for a name in a file; empty if it is not known.
std::string knownName(std::string_view name) {
  static const PlainNames names = makeNames();
  std::string letters = lettersOf(name);
  if (letters.starts_with("scalar")) letters.erase(0, 6);  // prefix of CloudCompare's fields in PLY
  const auto known = names.find(letters);
  return known == names.end() ? "" : known->second;
}

}  // namespace

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return std::tolower(c); });
  return result;
}

std::string plainName(std::string_view name) {
  static constexpr std::string_view around = "\"'` \t\r\n";
  const auto strip = [&name] {
    const std::size_t begin = std::min(name.find_first_not_of(around), name.size());
    name = name.substr(begin, name.find_last_not_of(around) + 1 - begin);
  };
  strip();
  if (const std::size_t unit = name.find_first_of("[("); unit != std::string_view::npos && unit > 0)
    name = name.substr(0, unit);
  strip();
  std::string word(name.empty() ? "_" : name);
  std::replace_if(
      word.begin(), word.end(), [](unsigned char c) { return c <= ' ' || c == 127; }, '_');
  return word;
}

void nameFields(std::vector<Field>& fields) {
  std::set<std::string> taken;
  std::set<std::string> letters;
  for (Field& field : fields) {
    field.name = plainName(field.name);
    if (field.name.size() == 1) letters.insert(lower(field.name));
    if (knownName(field.name) == field.name) taken.insert(field.name);
  }
  for (Field& field : fields)  // names that differ from their key only in capitals
    if (const std::string known = knownName(field.name); known == lower(field.name) && taken.insert(known).second)
      field.name = known;
  // Names of one letter are taken for colours only if r, g and b all occur.
  const bool are_colors = letters.contains("r") && letters.contains("g") && letters.contains("b");
  for (Field& field : fields) {
    const std::string known = knownName(field.name);
    const bool may_be_other = field.name.size() == 1 && colors.contains(known) && !are_colors;
    if (!known.empty() && !may_be_other && taken.insert(known).second) field.name = known;
  }
}

std::vector<std::string> partNames(std::string_view name, std::size_t count) {
  std::vector<std::string> names;
  if (count != 3 && count != 4) return names;
  for (std::size_t c = 0; c < count; ++c) {
    const std::string known = knownName(plainName(name) + ":" + std::to_string(c));
    if (known.empty() && c < 3) return {};
    names.push_back(known.empty() ? "_" : known);  // padding, as in x y z _
  }
  return names;
}

}  // namespace tufted::io

std::string tufted::fieldKey(std::string_view name) {
  const std::string plain = io::lower(io::plainName(name));
  const std::string known = io::knownName(plain);
  return known.empty() ? plain : known;
}

std::ptrdiff_t tufted::findField(const std::vector<std::string>& names, const std::string& name) {
  const auto find = [&](const auto& spelling) {
    const auto found = std::find_if(names.begin(), names.end(), [&, sought = spelling(name)](const std::string& other) {
      return spelling(other) == sought;
    });
    return found == names.end() ? -1 : found - names.begin();
  };
  std::ptrdiff_t found = find([](const std::string& text) { return text; });
  if (found < 0) found = find([](const std::string& text) { return io::lower(text); });
  return found < 0 ? find([](const std::string& text) { return fieldKey(text); }) : found;
}
