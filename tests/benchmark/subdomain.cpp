// SPDX-License-Identifier: Apache-2.0
#include "subdomain.h"

#include <cmath>
#include <numeric>

#include "partition/sharing.h"
#include "problem/subdomain_builder.h"
#include "stepping/subdomain_contacts.h"

namespace nscdd::benchmark {

SubdomainProblem BuildSubdomain(const StepProblem& step) {
  const ContactProblem& p = step.problem;
  std::vector<double> inverse_mass, inverse_inertia;
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    const bool free = !std::isinf(p.mass[i]);
    inverse_mass.push_back(free ? 1.0 / p.mass[i] : 0.0);
    inverse_inertia.push_back(free ? 1.0 / p.inertia[i] : 0.0);
  }
  SubdomainContacts all{0, {std::vector<std::int32_t>(p.contacts.size())}};
  std::iota(all.rows[0].begin(), all.rows[0].end(), 0);
  const auto is_free = [&](std::int32_t body) { return inverse_mass[body] > 0.0; };
  const Sharing sharing = MakeSharing(p.mass.size(), TouchedBodies(p.contacts, all, p.mass.size(), is_free));
  const ProblemTables tables{inverse_mass, inverse_inertia, p.free_velocity, &p.contacts, p.offset, &sharing};
  return SubdomainBuilder(tables, RequiredModel(tables)).Build(0, all.rows[0]);
}

}  // namespace nscdd::benchmark
