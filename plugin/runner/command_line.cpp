// SPDX-License-Identifier: Apache-2.0
#include "command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

#include "nscdd/error.h"
#include "scene/text.h"

namespace nscdd {
namespace {

constexpr std::int64_t kMost = 1'000'000'000;

template <class Number>
bool Parse(std::string_view text, Number* number) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), *number);
  return error == std::errc() && end == text.data() + text.size();
}

bool IsLong(std::string_view argument) { return argument.starts_with("--") && argument.size() > 2; }

bool IsShort(std::string_view argument) {
  return argument.size() == 2 && argument[0] == '-' && std::isalpha(static_cast<unsigned char>(argument[1])) != 0;
}

std::vector<std::string> CommandsOf(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> OptionsOf(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// The options from `arguments[first]` on.
void CheckOptions(const CLI::App& command, const std::string& prefix, std::span<char* const> arguments) {
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string_view argument = arguments[i];
    if (argument == "--") return;  // only positional arguments follow
    if (!IsLong(argument) && !IsShort(argument)) continue;
    const std::string name(argument.substr(0, argument.find('=')));
    const CLI::Option* option = command.get_option_no_throw(name);
    if (option == nullptr) {
      throw Error(Sentence(fmt::format("{}there is no option '{}'; {}", prefix, Printable(name),
                                       Suggestion(name, OptionsOf(command), "options"))));
    }
    if (name.size() < argument.size() || option->get_expected_min() == 0) continue;
    if (i + 1 == arguments.size() || IsLong(arguments[i + 1])) {
      throw Error(fmt::format("{}{} lacks its value{}; write {} VALUE, or {}=VALUE if it begins with --.", prefix, name,
                              i + 1 == arguments.size() ? "" : fmt::format(" ({} follows)", Printable(arguments[i + 1])), name,
                              name));
    }
    ++i;
  }
}

}  // namespace

void CheckArguments(const CLI::App& program, std::span<char* const> arguments) {
  if (arguments.size() < 2)
    throw Error(fmt::format("give a command: {}; see `nscdd --help`.", fmt::join(CommandsOf(program), ", ")));
  const std::string word = arguments[1];
  if (word.starts_with('-')) return CheckOptions(program, "", arguments.subspan(1));
  const std::vector<const CLI::App*> named = program.get_subcommands([&](const CLI::App* c) { return c->get_name() == word; });
  if (named.empty()) {
    throw Error(Sentence(
        fmt::format("there is no command '{}'; {}", Printable(word), Suggestion(word, CommandsOf(program), "commands"))));
  }
  CheckOptions(*named.front(), word + ": ", arguments.subspan(2));
}

std::int64_t ParseWhole(const std::string& option, const std::string& text, std::int64_t least) {
  std::int64_t number = 0;
  if (Parse(text, &number) && number >= least && number <= kMost) return number;
  throw CLI::ValidationError(option, fmt::format("'{}' is no whole number from {} to 1e9", Printable(text), least));
}

double ParsePositive(const std::string& option, const std::string& text) {
  double number = 0.0;
  if (Parse(text, &number) && std::isnormal(number) && number > 0.0 && number <= static_cast<double>(kMost)) return number;
  throw CLI::ValidationError(option, fmt::format("'{}' is no number above 0 up to 1e9", Printable(text)));
}

CLI::Option* AddPositive(CLI::App* command, const std::string& flag, std::optional<double>* target, const std::string& help) {
  const auto set = [=](const std::string& text) { *target = ParsePositive(flag, text); };
  return command->add_option_function<std::string>(flag, set, help)->type_name("FLOAT");
}

}  // namespace nscdd
