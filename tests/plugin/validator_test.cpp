// SPDX-License-Identifier: Apache-2.0
#include "nscdd/host/validator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "validator/check_list.h"
#include "validator/child_process.h"

namespace nscdd {
namespace {

struct Verdict {
  int failed = 0;
  std::string text;  // all lines
  std::vector<std::string> failures;
};

Verdict Validate(const std::string& path, double seconds = 30.0, const std::string& only = "") {
  Verdict verdict;
  verdict.failed = ValidatePlugin(path, {seconds, only, [&](const std::string& line) {
                                           verdict.text += line + "\n";
                                           if (line.starts_with("FAILED")) verdict.failures.push_back(line);
                                         }});
  return verdict;
}

std::string Bad(const std::string& name) { return std::string(BAD_FOLDER) + "/" + name + ".so"; }

TEST(Validator, AcceptsOurs) {
  const Verdict verdict = Validate(PLUGIN_FILE);
  EXPECT_EQ(verdict.failed, 0) << verdict.text;
  EXPECT_EQ(static_cast<std::size_t>(std::count(verdict.text.begin(), verdict.text.end(), '\n')), AllChecks().size());
}

TEST(Validator, StopsWhenThePluginDoesNotLoad) {
  for (const char* name : {"text", "missing", "wrong_major", "truncated", "no_symbol", "null_entry", "other_mpi"}) {
    const Verdict verdict = Validate(Bad(name));
    EXPECT_EQ(verdict.failed, 1) << name << "\n" << verdict.text;
    EXPECT_NE(verdict.text.find("skipped"), std::string::npos) << verdict.text;
  }
}

TEST(Validator, SurvivesACrash) {
  const Verdict verdict = Validate(Bad("crashing"));
  EXPECT_GT(verdict.failed, 5) << verdict.text;
  EXPECT_NE(verdict.text.find("it crashed with signal 6"), std::string::npos) << verdict.text;
}

TEST(Validator, DoesNotWaitForEver) {
  const Verdict verdict = Validate(Bad("hanging"), 0.2);
  EXPECT_GT(verdict.failed, 5) << verdict.text;
  EXPECT_NE(verdict.text.find("no answer within 0.2 s"), std::string::npos) << verdict.text;
}

struct Fault {
  const char* name;
  const char* check;  // that must notice
};

void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

class FaultyPlugin : public testing::TestWithParam<Fault> {};

TEST_P(FaultyPlugin, IsCaught) {
  setenv("NSCDD_FAULT", GetParam().name, 1);
  const Verdict verdict = Validate(Bad("faulty_plugin"), 30.0, GetParam().check);
  unsetenv("NSCDD_FAULT");
  EXPECT_EQ(verdict.failed, 1) << verdict.text;
}

INSTANTIATE_TEST_SUITE_P(
    Faults, FaultyPlugin,
    testing::Values(Fault{"new_description", "same description"}, Fault{"loud_name", "names of solvers"},
                    Fault{"bad_default", "defaults have"}, Fault{"bad_checked_default", "defaults have"},
                    Fault{"leak", "no memory behind"}, Fault{"slow_step", "steps two disks"},
                    Fault{"shared_handle", "do not disturb"}, Fault{"no_load", "saved state"},
                    Fault{"no_load_states", "saved state"}, Fault{"mpi", "leaves MPI alone"}, Fault{"normal", "disk at rest"},
                    Fault{"tangential", "sliding disk"}, Fault{"inelastic", "head-on impact"},
                    Fault{"sticky", "opening contact"}, Fault{"any_option", "unknown solvers, options"},
                    Fault{"any_checked_option", "unknown solvers, options"}, Fault{"null_arguments", "null pointers"},
                    Fault{"destroy_null", "null pointers"}, Fault{"truncated", "truncated structures"},
                    Fault{"long_sentence", "terminates its sentences"}, Fault{"host_failure", "failing host"},
                    Fault{"silent", "failing host"}, Fault{"nan", "not numbers"}, Fault{"any_dt", "not numbers"},
                    Fault{"any_state", "wrong states"}, Fault{"any_states", "wrong states"}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST(FaultyPluginItself, HasNoOtherFault) {
  setenv("NSCDD_FAULT", "none", 1);
  const Verdict verdict = Validate(Bad("faulty_plugin"));
  unsetenv("NSCDD_FAULT");
  // It is compiled without a version script and exports more than the entry, which is a fault of its own.
  for (const std::string& line : verdict.failures) EXPECT_NE(line.find("exports one symbol"), std::string::npos) << line;
}

TEST(ExportCheck, CatchesASecondSymbol) {
  const Verdict verdict = Validate(Bad("two_symbols"));
  EXPECT_NE(verdict.text.find("FAILED  exports one symbol: it exports 2 symbols, among them 'another_entry'"),
            std::string::npos)
      << verdict.text;
}

TEST(Validator, RunsChosenChecksOnly) {
  EXPECT_EQ(Validate(PLUGIN_FILE, 30.0, "refuses null").text, "ok      refuses null pointers\n");
  EXPECT_THROW(Validate(PLUGIN_FILE, 30.0, "no such check"), Error);
}

TEST(RunInChild, TellsHowItEnded) {
  EXPECT_EQ(RunInChild([] {}, 5.0).sentence, "");
  EXPECT_EQ(RunInChild([] { throw Error("no luck"); }, 5.0).sentence, "no luck");
  EXPECT_EQ(RunInChild([] { std::_Exit(3); }, 5.0).sentence, "it ended the process with exit code 3");
  EXPECT_EQ(RunInChild([] { std::_Exit(0); }, 5.0).sentence, "it ended the process with exit code 0");
}

}  // namespace
}  // namespace nscdd
