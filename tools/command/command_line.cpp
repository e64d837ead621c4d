#include "command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstddef>
#include <set>

#include "options.h"
#include "suggestion.h"

namespace {

std::vector<const CLI::App*> commandsOf(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

const CLI::App* commandNamed(const CLI::App& app, const std::string& name) {
  for (const CLI::App* command : commandsOf(app))
    if (command->check_name(name)) return command;
  return nullptr;
}

/// Whether CLI11 takes a word for an option and not for a value such as -1,0,0.
bool isOption(const std::string& word) {
  return word.size() > 1 && word[0] == '-' &&
         (word[1] == '-' || std::isalpha(static_cast<unsigned char>(word[1])) != 0);
}

bool isNumber(const std::string& word) {
  double number = 0;
  return parseNumber(word, number);
}

/// The option's name in `--name=value` or `-nvalue`.
std::string nameIn(const std::string& word) {
  return word[1] == '-' ? word.substr(0, word.find('=')) : word.substr(0, 2);
}

const CLI::Option* optionNamed(const CLI::App& command, const std::string& name) {
  for (const CLI::Option* option : command.get_options())
    if (option->nonpositional() && option->check_name(name)) return option;
  return nullptr;
}

/// Whether a word is a long option with a single dash.
bool lacksDash(const CLI::App& command, const std::string& word) {
  return isOption(word) && word[1] != '-' && word.size() > 2 && optionNamed(command, nameIn('-' + word)) != nullptr;
}

std::string explainOption(const CLI::App& command, const std::string& name) {
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& word : option->get_lnames()) known.push_back("--" + word);
  return "unknown option `" + name + "`" + didYouMean(name, known);
}

/// Explains the first option that a command does not have; an empty string if it has all.
std::string findUnknownOption(const CLI::App& command, const std::vector<std::string>& arguments) {
  for (std::size_t i = 0; i < arguments.size() && arguments[i] != "--"; ++i) {
    const std::string& word = arguments[i];
    if (!isOption(word)) continue;
    const std::string typed = word.substr(0, word.find('='));
    const CLI::Option* const option = optionNamed(command, nameIn(word));
    if (option == nullptr || lacksDash(command, word)) return explainOption(command, typed);
    const bool has_value = word.size() > nameIn(word).size();
    const bool takes_next = option->get_items_expected_min() > 0 && !has_value && i + 1 < arguments.size();
    if (takes_next && !isOption(arguments[i + 1])) ++i;
  }
  return "";
}

/// Explains a wrong use of a known option: without a value, with blanks instead of commas in its list, or given twice.
/// An empty string if there is none.
std::string findMisusedOption(const CLI::App& command, const std::vector<std::string>& arguments) {
  std::set<const CLI::Option*> seen;
  for (std::size_t i = 0; i < arguments.size() && arguments[i] != "--"; ++i) {
    const std::string& word = arguments[i];
    const CLI::Option* const option = isOption(word) ? optionNamed(command, nameIn(word)) : nullptr;
    if (option == nullptr) continue;
    const std::string name = nameIn(word);
    const bool is_single =
        option->get_items_expected_max() == 1 && option->get_multi_option_policy() == CLI::MultiOptionPolicy::Throw;
    if (!seen.insert(option).second && is_single) return name + " is given twice, must be given once";
    if (option->get_items_expected_min() == 0 || word.size() > name.size()) continue;
    const std::string type = option->get_type_name();
    const bool has_value =
        i + 1 < arguments.size() && !(isOption(arguments[i + 1]) && optionNamed(command, nameIn(arguments[i + 1])));
    if (!has_value) return name + " has no value, must have " + type;
    std::size_t end = ++i + 1;
    while (end < arguments.size() && isNumber(arguments[end - 1]) && isNumber(arguments[end])) ++end;
    if (end == i + 1 || type.find(',') == std::string::npos) continue;
    std::string blanks, commas;
    for (; i < end; ++i) {
      blanks += " " + arguments[i];
      commas += (commas.empty() ? " " : ",") + arguments[i];
    }
    return name + blanks + " has blanks between its numbers, must have commas: " + name + commas;
  }
  return "";
}

std::string explainCommand(const CLI::App& app, const std::string& name) {
  std::vector<std::string> known;
  for (const CLI::App* command : commandsOf(app))
    if (!command->get_group().empty()) known.push_back(command->get_name());  // else hidden in the help
  const std::string all = joined(known);
  known.insert(known.end(), {"--help", "--version"});
  const std::string meant = didYouMean(name, known);
  return "unknown command `" + name + "`" + (meant.empty() ? ", must be one of " + all : meant);
}

}  // namespace

bool isMisleading(const CLI::App& app, const std::vector<std::string>& arguments) {
  if (arguments.empty() || arguments[0].starts_with('-')) return false;
  const CLI::App* const command = commandNamed(app, arguments[0]);
  const auto end = std::find(arguments.begin(), arguments.end(), "--");
  return command == nullptr ||
         std::any_of(arguments.begin(), end, [&](const std::string& word) { return lacksDash(*command, word); });
}

std::string explainArguments(const CLI::App& app, const std::vector<std::string>& arguments, const std::string& error) {
  const auto first =
      std::find_if(arguments.begin(), arguments.end(), [](const std::string& word) { return !word.starts_with('-'); });
  const CLI::App* const command = first == arguments.end() ? nullptr : commandNamed(app, *first);
  std::string fault = findUnknownOption(app, {arguments.begin(), first});
  if (fault.empty() && first != arguments.end() && command == nullptr) fault = explainCommand(app, *first);
  if (fault.empty() && command != nullptr) fault = findUnknownOption(*command, {first + 1, arguments.end()});
  if (fault.empty() && command != nullptr) fault = findMisusedOption(*command, {first + 1, arguments.end()});
  return (fault.empty() ? error : fault) + " (see tufted " + (command == nullptr ? "" : command->get_name() + " ") +
         "--help)";
}
