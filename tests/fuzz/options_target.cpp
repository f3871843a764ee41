// SPDX-License-Identifier: Apache-2.0
// Option strings through the C interface. The first line of an input names the solver, each further one is NAME=VALUE; without
// '=' the value is a null pointer.

#include <string>
#include <string_view>
#include <vector>

#include "nscdd_plugin.h"
#include "target.h"

extern "C" const nscdd_plugin* nscdd_plugin_entry(void);

namespace {

struct Text {
  std::string name, value;
  bool has_value;
};

std::vector<Text> Split(std::string_view input) {
  std::vector<Text> lines;
  while (!input.empty()) {
    const std::string_view line = input.substr(0, input.find('\n'));
    input.remove_prefix(std::min(input.size(), line.size() + 1));
    const auto equals = line.find('=');
    const bool has_value = equals != std::string_view::npos;
    lines.push_back({std::string(line.substr(0, equals)), has_value ? std::string(line.substr(equals + 1)) : "", has_value});
  }
  return lines;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::vector<Text> lines = Split({reinterpret_cast<const char*>(data), size});
  if (lines.empty()) return 0;
  std::vector<const char*> names, values;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    names.push_back(lines[i].name.c_str());
    values.push_back(lines[i].has_value ? lines[i].value.c_str() : nullptr);
  }
  nscdd_create_arguments arguments{};
  arguments.header = {sizeof arguments, NSCDD_ABI_MAJOR, NSCDD_ABI_MINOR};
  arguments.solver = lines[0].name.c_str();
  arguments.option_count = names.size();
  arguments.option_names = names.data();
  arguments.option_values = values.data();
  const nscdd_plugin* plugin = nscdd_plugin_entry();
  nscdd_solver* solver = nullptr;
  std::vector<char> sentence(1 + size % 700, 'x');  // cut to any length
  const std::int32_t result = plugin->create(&arguments, &solver, sentence.data(), sentence.size());
  if ((result == NSCDD_OK) != (solver != nullptr)) nscdd::fuzz::Fail("create: its result and its handle disagree");
  if (result == NSCDD_FAILED) nscdd::fuzz::Fail("create failed where it should refuse");
  if (std::string_view(sentence.data(), sentence.size()).find('\0') == std::string_view::npos)
    nscdd::fuzz::Fail("create: no terminator");
  if (result != NSCDD_OK && sentence.size() > 1) nscdd::fuzz::CheckSentence(sentence.data());
  plugin->destroy(solver);
  return 0;
}
