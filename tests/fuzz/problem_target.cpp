// SPDX-License-Identifier: Apache-2.0
// Problem files of `nscdd solve`: read, and solved by each solver with few iterations if small.

#include "nscdd/contact_problem.h"
#include "problem/problem_file.h"
#include "target.h"

namespace nscdd {
namespace {

template <class Options>
Options Few() {
  Options options;
  options.stopping.max_iterations = 6;
  options.stopping.test_every = 2;
  return options;
}

void Solve(ContactProblem problem) {
  SolveContactProblem(problem, Few<NscdOptions>());
  SolveContactProblem(problem, Few<NewtonOptions>());
  for (std::size_t c = 0; c < problem.contacts.size(); ++c) problem.subdomain.push_back(static_cast<int>(c % 3));
  SolveContactProblem(problem, Few<NscddOptions>());
  SolveContactProblem(problem, Few<FeaOptions>());
  IeaOptions iea = Few<IeaOptions>();
  iea.interface.solve = InterfaceSolve::kCg;
  iea.interface.cg_max_iterations = 10;
  SolveContactProblem(problem, iea);
}

}  // namespace
}  // namespace nscdd

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nscdd;
  static const fuzz::ScratchFolder folder;
  const auto path = folder.Write("problem.json", data, size);
  ProblemFile file;
  const bool read = fuzz::Accepts([&] { file = ReadProblemFile(path); });
  if (read && file.problem.contacts.size() <= 30) fuzz::Accepts([&] { Solve(file.problem); });
  return 0;
}
