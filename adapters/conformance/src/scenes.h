// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "check.h"

namespace nscdd::conformance {

/// A uniform number in [low, high).
double Uniform(double low, double high, std::mt19937_64* random);

/// Uniform multiples of 1/1024 in [low, high): exact in float.
double Dyadic(double low, double high, std::mt19937_64* random);

/// `count` disks with ids 10, 13, 16, ... and radii in [0.25, 1), centres in a square of `side` whose corner is `corner`; every
/// fifth one is prescribed. Returns the specs with the ids that the adapter uses.
std::vector<DiskSpec> AddRandomDisks(int count, Vec2 corner, double side, Session* session, std::mt19937_64* random);

/// Whole disks, whose contacts are known from the body table alone: gap between rows, B shifted by `shift` in x.
double DiskGap(const BodyTable& bodies, std::size_t a, std::size_t b, double shift = 0.0);

/// The contacts of whole disks must be those of a double loop over bodies and images, up to rounding at the alert distance.
void RequireAllPairs(const BodyTable& bodies, const ContactTable& contacts, double alert, double period = 0.0);

/// The same bodies with bitwise the same poses and velocities; `what` must not have changed them.
void RequireUnchanged(const BodyTable& before, const BodyTable& after, const char* what);

/// Largest |coordinate| of the poses, at least 1: what rounding is measured by [m].
double CoordinateScale(const BodyTable& bodies);

/// A floor of one kind with the id `id`: free side y > 0, surface through (0, 0). Nullopt: the platform has no such wall.
using AddFloor = std::optional<std::int64_t> (*)(std::int64_t id, double friction, Session* session);
std::optional<std::int64_t> AddHalfPlaneFloor(std::int64_t id, double friction, Session* session);
std::optional<std::int64_t> AddPolylineFloor(std::int64_t id, double friction, Session* session);
/// A fixed disk of radius 1 below the origin.
std::optional<std::int64_t> AddDiskFloor(std::int64_t id, double friction, Session* session);

}  // namespace nscdd::conformance
