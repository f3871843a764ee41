// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <set>

#include "nscdd/grid_size.h"
#include "nscdd/host/solver.h"
#include "validator/check_list.h"
#include "validator/elf_symbols.h"

namespace nscdd {
namespace {

constexpr std::size_t kLongestName = 64;

void Loads(const std::string& path) { PluginLibrary::Load(path); }

void ExportsOneSymbol(const std::string& path) {
  const std::vector<std::string> symbols = ExportedSymbols(path);
  for (const std::string& symbol : symbols) {
    Expect(symbol == NSCDD_ENTRY_SYMBOL,
           fmt::format("it exports {} symbols, among them '{}'; export {} alone (-fvisibility=hidden and a version script)",
                       symbols.size(), symbol, NSCDD_ENTRY_SYMBOL));
  }
}

void StableDescription(const std::string& path) {
  const auto library = PluginLibrary::Load(path);
  const auto entry = reinterpret_cast<nscdd_plugin_entry_function>(library->FindSymbol(NSCDD_ENTRY_SYMBOL));
  Expect(entry() == &library->plugin(), "its entry symbol gives another description at the second call; give the same one");
}

bool IsName(const std::string& text) {
  return !text.empty() && text.size() <= kLongestName &&
         text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == text.npos;
}

void SaneStrings(const std::string& path) {
  const auto library = PluginLibrary::Load(path);
  std::set<std::string> names;
  ForEachSolver(*library, [&](const std::string& name) {
    Expect(IsName(name), "its name must be made of a-z, 0-9 and _");
    Expect(names.insert(name).second, "it is listed twice");
    const nscdd_solver_info& info = *library->FindSolver(name);
    Expect(std::string(info.summary).find('\n') == std::string::npos, "its summary has more than one line");
    std::set<std::string> options;
    for (std::uint64_t i = 0; i < info.option_count; ++i) {
      const std::string option = info.options[i].name;
      Expect(IsName(option), fmt::format("the name of option '{}' must be made of a-z, 0-9 and _", option));
      Expect(options.insert(option).second, fmt::format("option '{}' is listed twice", option));
      Expect(std::string(info.options[i].help).find('\n') == std::string::npos,
             fmt::format("the help of option '{}' has more than one line", option));
    }
  });
}

// Whether `text` is a value of the option's type, by the rules of the header.
bool HasType(const nscdd_option& option, const std::string& text) {
  char* end = nullptr;
  switch (option.type) {
    case NSCDD_BOOL:
      return text == "true" || text == "false";
    case NSCDD_INTEGER:
      std::strtoll(text.c_str(), &end, 10);
      return *end == '\0';
    case NSCDD_REAL:
      std::strtod(text.c_str(), &end);
      return *end == '\0';
    case NSCDD_CHOICE:
      return fmt::format("|{}|", option.choices).find(fmt::format("|{}|", text)) != std::string::npos;
    case NSCDD_GRID:
      return ParseGrid(text).has_value();
    default:
      return false;
  }
}

void DefaultsAreAccepted(const std::string& path) {
  const auto library = PluginLibrary::Load(path);
  ForEachSolver(*library, [&](const std::string& name) {
    const nscdd_solver_info& info = *library->FindSolver(name);
    for (std::uint64_t i = 0; i < info.option_count; ++i) {
      const nscdd_option& option = info.options[i];
      Expect(HasType(option, option.default_value),
             fmt::format("the default '{}' of option '{}' is not of its type", option.default_value, option.name));
      const Solver solver(library,
                          {.solver = name, .options = {{option.name, option.default_value}}, .host = {}, .communicator = {}});
      CheckOption(library, name, option.name, option.default_value);
    }
  });
}

}  // namespace

std::vector<Check> EntryChecks() {
  return {
      {"loads and has a good header, strings and functions", Loads},
      {"exports one symbol", ExportsOneSymbol},
      {"gives the same description at each call", StableDescription},
      {"names of solvers and options are sane", SaneStrings},
      {"defaults have their type and are accepted", DefaultsAreAccepted},
  };
}

}  // namespace nscdd
