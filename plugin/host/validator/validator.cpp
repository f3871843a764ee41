// SPDX-License-Identifier: Apache-2.0
#include "nscdd/host/validator.h"

#include <fmt/format.h>

#include "validator/check_list.h"
#include "validator/child_process.h"

namespace nscdd {
namespace {

std::vector<Check> ChosenChecks(const std::string& only) {
  std::vector<Check> checks = AllChecks();
  std::erase_if(checks, [&](const Check& check) { return check.name.find(only) == std::string::npos; });
  if (checks.empty()) throw Error(fmt::format("no check has '{}' in its name; leave it out to run all", only));
  return checks;
}

}  // namespace

int ValidatePlugin(const std::string& path, const ValidatorOptions& options) {
  const auto print = [&](const std::string& line) {
    if (options.print) options.print(line);
  };
  const std::vector<Check> checks = ChosenChecks(options.only);
  int failed = 0;
  for (std::size_t i = 0; i < checks.size(); ++i) {
    const Check& check = checks[i];
    const ChildOutcome outcome = RunInChild([&] { check.run(path); }, options.seconds_per_check);
    if (outcome.sentence.empty()) {
      print(fmt::format("ok      {}", check.name));
      continue;
    }
    ++failed;
    print(fmt::format("FAILED  {}: {}", check.name, outcome.sentence));
    if (i > 0 || !options.only.empty()) continue;
    print(fmt::format("skipped {} checks that need a plugin that loads", checks.size() - 1));
    break;
  }
  return failed;
}

}  // namespace nscdd
