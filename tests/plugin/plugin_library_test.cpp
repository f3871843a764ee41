// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>

#include "expect_error.h"
#include "nscdd/host/plugin_library.h"
#include "nscdd/host/solver_registry.h"
#include "validator/elf_symbols.h"

namespace nscdd {
namespace {

std::string Bad(const std::string& name) { return std::string(BAD_FOLDER) + "/" + name + ".so"; }

// Loading the bad plugin must throw a sentence with the file's name and `parts`.
void ExpectRefused(const std::string& name, std::vector<std::string> parts) {
  SCOPED_TRACE(name);
  parts.push_back(name + ".so");
  ExpectError([&] { PluginLibrary::Load(Bad(name)); }, parts);
}

TEST(PluginLibrary, LoadsOurs) {
  const auto library = PluginLibrary::Load(PLUGIN_FILE);
  EXPECT_STREQ(library->plugin().name, "nscdd");
  EXPECT_NE(library->FindSolver("nscd"), nullptr);
  EXPECT_NE(library->FindSolver("nscdd"), nullptr);
  EXPECT_EQ(library->FindSolver("NSCD"), nullptr);
  EXPECT_EQ(library->plugin().mpi_library, HostAbi().mpi_library);
}

TEST(PluginLibrary, LoadsASoundOne) { EXPECT_STREQ(PluginLibrary::Load(Bad("sound"))->plugin().name, "bad"); }

TEST(PluginLibrary, RefusesWhatIsNoPlugin) {
  ExpectRefused("missing", {"no such file"});
  ExpectRefused("text", {"not a shared library"});
  ExpectRefused("no_symbol", {"nscdd_plugin_entry"});
  ExpectRefused("null_entry", {"returned null"});
  ExpectError([] { PluginLibrary::Load(""); }, {"path of the plugin is empty"});
  ExpectError([] { PluginLibrary::Load(BAD_FOLDER); }, {"not a regular file"});
}

TEST(PluginLibrary, RefusesAnotherAbi) {
  ExpectRefused("wrong_major", {"ABI major 2", "needs 1"});
  ExpectRefused("truncated", {"24 bytes", std::to_string(HostAbi().struct_size)});
  ExpectRefused("short_minor", {"ABI 1.1", std::to_string(offsetof(nscdd_plugin, check_option))});
  ExpectRefused("other_mpi", {"Some Other MPI 7.0", HostAbi().mpi_library, "rebuild the plugin"});
}

TEST(PluginLibrary, RefusesAMinorBelowTheNeeded) {
  HostAbi newer;
  newer.minor = 1;
  ExpectError([&] { PluginLibrary::Load(Bad("old_minor"), newer); }, {"old_minor.so", "ABI 1.0", "at least 1.1"});
}

TEST(PluginLibrary, AnOlderMinorServesButForCheckpoints) {
  const auto old = PluginLibrary::Load(Bad("old_minor"));
  EXPECT_STREQ(old->plugin().name, "old");
  ExpectError([&] { old->RequireLoadStates(); }, {"old_minor.so", "ABI 1.0", "checkpoints need 1.1", "update"});
  EXPECT_NO_THROW(PluginLibrary::Load(Bad("sound"))->RequireLoadStates());
}

TEST(SolverRegistry, AsksThePluginAboutAnOption) {
  for (const char* fault : {"none", "old_minor"}) {  // which has no check_option, but makes handles
    SCOPED_TRACE(fault);
    setenv("NSCDD_FAULT", fault, 1);
    SolverRegistry registry;
    registry.Add(Bad("faulty_plugin"));
    unsetenv("NSCDD_FAULT");
    EXPECT_EQ(registry.entries()[0].module->plugin().check_option == nullptr, std::string(fault) == "old_minor");
    EXPECT_NO_THROW(registry.CheckOption("nscdd", "subdomains", "4x2"));
    ExpectError([&] { registry.CheckOption("nscdd", "subdomains", "4"); }, {"option 'subdomains' is '4'", "4x2"});
    ExpectError([&] { registry.CheckOption("nscd", "subdomains", "4x2"); }, {"'nscd' has no option 'subdomains'"});
    ExpectError([&] { registry.CheckOption("none", "subdomains", "4x2"); }, {"no solver 'none'"});
  }
}

TEST(PluginLibrary, RefusesHolesInTheDescription) {
  ExpectRefused("null_function", {"function step is null"});
  ExpectRefused("null_name", {"name is null"});
  ExpectRefused("no_solvers", {"0 solvers"});
  ExpectRefused("unknown_type", {"type 77"});
}

TEST(PluginLibrary, OursExportsOneSymbol) {
  EXPECT_EQ(ExportedSymbols(PLUGIN_FILE), std::vector<std::string>{NSCDD_ENTRY_SYMBOL});
}

TEST(FindPlugin, PrefersTheOptionThenTheEnvironment) {
  setenv("NSCDD_PLUGIN", "/from/environment.so", 1);
  EXPECT_EQ(FindPlugin("/from/option.so"), "/from/option.so");
  EXPECT_EQ(FindPlugin(""), "/from/environment.so");
  unsetenv("NSCDD_PLUGIN");
}

TEST(SolverRegistry, FindsSolversOfSeveralPlugins) {
  SolverRegistry registry;
  registry.Add(PLUGIN_FILE);
  const std::size_t ours = registry.entries().size();
  registry.Add(Bad("sound"));
  EXPECT_EQ(registry.entries().size(), ours + 1);
  EXPECT_STREQ(registry.Find("nothing").info->name, "nothing");
  ExpectError([&] { registry.Find("ncsd"); }, {"no solver 'ncsd'", "nscdd", "nothing"});
}

TEST(SolverRegistry, RefusesASolverNameTwice) {
  SolverRegistry registry;
  registry.Add(Bad("sound"));
  ExpectError([&] { registry.Add(Bad("old_minor")); }, {"old_minor.so", "'nothing'", "sound.so"});
  EXPECT_EQ(registry.entries().size(), 1u);
}

}  // namespace
}  // namespace nscdd
