// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nscdd {

/// Contacts per packet, at most.
inline constexpr std::int32_t kPacketSize = 8;

/// An order of contacts in packets: no two contacts of a packet share a free body, so that they can be solved at once.
struct PacketOrder {
  std::vector<std::int32_t> contact;  ///< the given contacts, packet after packet
  std::vector<std::int32_t> begin;    ///< first place of each packet, and the number of contacts
};

/// List scheduling: each contact, in the given order, goes to the first packet with room after the packets of its two bodies.
/// The contacts OF EACH BODY keep their order, and a local solve reads nothing but its two bodies: a Gauss-Seidel sweep in this
/// order leaves the same bits as one in the given order.
class PacketScheduler {
 public:
  /// Bodies with inverse mass 0 are prescribed: any number of contacts of a packet may touch one. Not owned.
  explicit PacketScheduler(std::span<const double> inverse_mass)
      : inverse_mass_(inverse_mass), earliest_(inverse_mass.size()) {}

  /// `contacts`: rows of the table whose columns `a` and `b` name the rows of the bodies.
  PacketOrder Order(std::span<const std::int32_t> contacts, std::span<const std::int32_t> a, std::span<const std::int32_t> b);

 private:
  std::span<const double> inverse_mass_;
  std::vector<std::int32_t> earliest_;  // packet after the last one of each body; zero between two calls
};

}  // namespace nscdd
