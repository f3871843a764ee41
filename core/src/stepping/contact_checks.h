// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "nscdd/body_table.h"
#include "nscdd/contact_table.h"
#include "nscdd/platform_adapter.h"

namespace nscdd {

/// Throws Error when the period begins so far from 0 that rounding swallows it.
void CheckPeriod(const AdapterDescription& adapter);

/// Throws Error, naming the adapter, its function and the body or contact, when a table breaks the contract of
/// platform_adapter.h: lengths of columns, ids, finite numbers, positive masses.
void CheckBodies(const BodyTable& bodies, const AdapterDescription& adapter);

/// Throws Error, naming the body, when its position after `half` [s] at its velocity is not finite.
void CheckDrift(const BodyTable& bodies, double half, const AdapterDescription& adapter);

/// Throws Error, naming the body, when its loads make a velocity that is not finite.
void CheckMotion(const BodyTable& bodies, std::span<const Twist> motion);

/// As CheckBodies, for contacts: rows, order of keys, none twice, unit normals, gaps up to the sum of both `reach`, moments,
/// friction, restitution, a free body. Arms on free bodies need the capability `clusters`. `function` found them.
void CheckContacts(const ContactTable& contacts, const BodyTable& bodies, std::span<const double> reach, const char* function,
                   const AdapterDescription& adapter);

}  // namespace nscdd
