// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace nscdd {

/// Refuses, with the nearest name, commands and options that there are not, and options whose value is missing: CLI11 takes
/// whatever follows an option for its value, even if that is the next option. A value that does begin with "--" is written
/// --option=--value. `arguments` are those of main. Throws Error.
void CheckArguments(const CLI::App& program, std::span<char* const> arguments);

/// A whole number from `least` to 1e9, decimal also with leading zeros. Throws CLI::ValidationError.
std::int64_t ParseWhole(const std::string& option, const std::string& text, std::int64_t least);
/// A finite number above 0, up to 1e9. Throws CLI::ValidationError.
double ParsePositive(const std::string& option, const std::string& text);

/// An option that takes a whole number; `target` is an integer, or an optional one.
template <class Target>
CLI::Option* AddWhole(CLI::App* command, const std::string& flag, std::int64_t least, Target* target, const std::string& help) {
  const auto set = [=](const std::string& text) { *target = ParseWhole(flag, text, least); };
  return command->add_option_function<std::string>(flag, set, help)->type_name("INT");
}

/// An option that takes a positive number.
CLI::Option* AddPositive(CLI::App* command, const std::string& flag, std::optional<double>* target, const std::string& help);

}  // namespace nscdd
