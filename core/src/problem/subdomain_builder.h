// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nscdd/contact_table.h"
#include "partition/sharing.h"
#include "problem/packet_order.h"
#include "problem/subdomain_problem.h"

namespace nscdd {

/// The tables of a rank that problems are built from; one entry per body or contact. Not owned.
struct ProblemTables {
  std::span<const double> inverse_mass;     ///< 1/M [1/kg]; 0: prescribed
  std::span<const double> inverse_inertia;  ///< 1/I [1/(kg m^2)]; 0: prescribed
  std::span<const Twist> free_velocity;     ///< V_f; of prescribed bodies their velocity
  const ContactTable* contacts = nullptr;
  std::span<const double> offset;  ///< b_n [m/s]
  const Sharing* sharing = nullptr;
};

/// What these tables require: friction if any contact has some, arms if a free body is touched away from its centre.
ContactModel RequiredModel(const ProblemTables& tables);

/// Builds subdomain problems one after the other; keeps its scratch between them.
class SubdomainBuilder {
 public:
  SubdomainBuilder(const ProblemTables& tables, ContactModel model);

  /// `rows`: the subdomain's contacts, in the order that the sweep keeps for every body.
  SubdomainProblem Build(int subdomain, const std::vector<std::int32_t>& rows);

 private:
  std::int32_t CopyOf(std::int32_t body, Vec2 arm, SubdomainProblem* problem);
  template <class Row>
  Row MakeRow(std::int32_t contact, SubdomainProblem* problem);

  ProblemTables tables_;
  ContactModel model_;
  bool shared_;
  PacketScheduler scheduler_;
  std::vector<std::int32_t> copy_of_row_;  // -1: none yet
};

}  // namespace nscdd
