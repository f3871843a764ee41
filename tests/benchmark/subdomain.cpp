// SPDX-License-Identifier: Apache-2.0
#include "subdomain.h"

#include <cmath>
#include <numeric>

#include "partition/sharing.h"
#include "problem/subdomain_builder.h"

namespace nscdd::benchmark {

SubdomainProblem BuildSubdomain(const StepProblem& step) {
  const ContactProblem& p = step.problem;
  std::vector<double> inverse_mass, inverse_inertia;
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    const bool free = !std::isinf(p.mass[i]);
    inverse_mass.push_back(free ? 1.0 / p.mass[i] : 0.0);
    inverse_inertia.push_back(free ? 1.0 / p.inertia[i] : 0.0);
  }
  std::vector<std::int32_t> contacts(p.contacts.size());
  std::iota(contacts.begin(), contacts.end(), 0);
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (const std::int32_t c : contacts) {
    for (const std::int32_t body : {p.contacts.a[c], p.contacts.b[c]}) {
      if (inverse_mass[body] > 0.0) pairs.emplace_back(body, 0);
    }
  }
  const Sharing sharing = MakeSharing(p.mass.size(), std::move(pairs));
  const ProblemTables tables{inverse_mass, inverse_inertia, p.free_velocity, &p.contacts, p.offset, &sharing};
  return SubdomainBuilder(tables, RequiredModel(tables)).Build(0, std::move(contacts));
}

}  // namespace nscdd::benchmark
