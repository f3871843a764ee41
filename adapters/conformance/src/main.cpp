// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <cstring>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "check.h"
#include "nscdd/error.h"

namespace nscdd::conformance {
namespace {

constexpr int kPassed = 0, kFailed = 1, kUsage = 2, kSkipped = 77;

struct Arguments {
  std::string check;
  std::uint64_t seed = 1;
  bool list = false;
  bool broken = false;
};

std::optional<Arguments> Parse(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool has_value = i + 1 < argc;
    if (word == "--list") {
      arguments.list = true;
    } else if (word == "--broken") {
      arguments.broken = true;
    } else if (word == "--check" && has_value) {
      arguments.check = argv[++i];
    } else if (word == "--seed" && has_value) {
      const char* text = argv[++i];
      const char* end = text + std::strlen(text);
      if (std::from_chars(text, end, arguments.seed).ptr != end) return std::nullopt;
    } else {
      return std::nullopt;
    }
  }
  return arguments;
}

int Report(int outcome, const Check& check, const std::string& detail) {
  const char* word = outcome == kPassed ? "PASS" : outcome == kSkipped ? "SKIP" : "FAIL";
  fmt::print("{} {}: {}\n", word, check.name, detail);
  std::fflush(stdout);  // the next check may crash
  return outcome;
}

int Run(const Check& check, const HostFactory& factory, const Arguments& arguments) {
  Trial trial(factory, arguments.seed, nullptr);
  try {
    check.run(&trial);
  } catch (const CheckSkipped& skipped) {
    return Report(kSkipped, check, skipped.what());
  } catch (const CheckFailed& failed) {
    return Report(kFailed, check, failed.what());
  } catch (const std::exception& error) {
    return Report(kFailed, check, fmt::format("a correct call was refused: {}", error.what()));
  }
  return Report(kPassed, check, check.claim);
}

/// Passes if the check fails on every broken adapter.
int RunBroken(const Check& check, const HostFactory& factory, const Arguments& arguments) {
  for (const Fault& fault : check.faults) {
    Trial trial(factory, arguments.seed, &fault);
    try {
      check.run(&trial);
    } catch (const CheckSkipped& skipped) {
      return Report(kSkipped, check, skipped.what());
    } catch (const std::exception& caught) {
      fmt::print("caught \"{}\": {}\n", fault.name, caught.what());
      continue;
    }
    return Report(kFailed, check, fmt::format("the check passes an adapter that is broken on purpose: {}", fault.name));
  }
  return Report(kPassed, check, fmt::format("{} broken adapters were caught", check.faults.size()));
}

}  // namespace

int Main(int argc, char** argv, const HostFactory& factory) {
  const std::optional<Arguments> arguments = Parse(argc, argv);
  if (!arguments) {
    fmt::print(stderr, "usage: {} [--check NAME] [--list] [--seed S] [--broken]\n", argv[0]);
    return kUsage;
  }
  bool found = false, failed = false;
  int last = kPassed;
  if (!arguments->list) fmt::print("seed {}\n", arguments->seed);
  for (const Check& check : AllChecks()) {
    if (!arguments->check.empty() && arguments->check != check.name) continue;
    found = true;
    if (arguments->list) {
      fmt::print("{}\n", check.name);
      continue;
    }
    last = arguments->broken ? RunBroken(check, factory, *arguments) : Run(check, factory, *arguments);
    failed = failed || last == kFailed;
  }
  if (!found) {
    fmt::print(stderr, "There is no check \"{}\"; --list names them.\n", arguments->check);
    return kUsage;
  }
  if (arguments->check.empty()) return failed ? kFailed : kPassed;
  return last;
}

}  // namespace nscdd::conformance
