// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "nscdd/contact_table.h"
#include "nscdd/normal_law.h"
#include "partition/grid.h"
#include "partition/sharing.h"

namespace nscdd {

/// Which contacts each of this rank's subdomains solves.
struct SubdomainContacts {
  int first = 0;                                ///< number of the rank's first subdomain
  std::vector<std::vector<std::int32_t>> rows;  ///< of the table of contacts, a list per subdomain in the order of the sweep
};

/// Each contact that the law sees goes to the subdomain of its site, where that is one of `count` from `first` on.
inline SubdomainContacts ChooseContacts(const ContactTable& contacts, NormalLaw law, const Grid& grid, int first, int count) {
  SubdomainContacts chosen{first, std::vector<std::vector<std::int32_t>>(count)};
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (!Sees(law, contacts.gap[c])) continue;
    const int e = grid.CellOf(contacts.site[c]) - first;
    if (e >= 0 && e < count) chosen.rows[e].push_back(static_cast<std::int32_t>(c));
  }
  return chosen;
}

/// (body, subdomain) of every free body with a contact in one of these subdomains, each once. `bodies`: their number.
template <class IsFree>
SubdomainPairs TouchedBodies(const ContactTable& contacts, const SubdomainContacts& chosen, std::size_t bodies,
                             IsFree is_free) {
  SubdomainPairs pairs;
  pairs.reserve(bodies);
  std::vector<std::int32_t> last(bodies, -1);  // subdomain that named the body last
  for (std::size_t e = 0; e < chosen.rows.size(); ++e) {
    const std::int32_t subdomain = chosen.first + static_cast<std::int32_t>(e);
    for (const std::int32_t c : chosen.rows[e]) {
      for (const std::int32_t body : {contacts.a[c], contacts.b[c]}) {
        if (last[body] == subdomain || !is_free(body)) continue;
        last[body] = subdomain;
        pairs.emplace_back(body, subdomain);
      }
    }
  }
  return pairs;
}

}  // namespace nscdd
