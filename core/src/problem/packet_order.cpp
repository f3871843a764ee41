// SPDX-License-Identifier: Apache-2.0
#include "problem/packet_order.h"

#include <algorithm>
#include <utility>

namespace nscdd {
namespace {

/// The first packet from a given one on that has room, in nearly constant time: full ones point onwards.
class RoomFinder {
 public:
  std::int32_t FirstWithRoom(std::int32_t packet) {
    if (packet >= static_cast<std::int32_t>(onward_.size())) Grow(packet + 1);
    std::int32_t root = packet;
    while (onward_[root] != root) root = onward_[root];
    while (onward_[packet] != root) packet = std::exchange(onward_[packet], root);
    return root;
  }

  void Fill(std::int32_t packet) {
    if (++count_[packet] < kPacketSize) return;
    if (packet + 1 == static_cast<std::int32_t>(onward_.size())) Grow(packet + 2);
    onward_[packet] = packet + 1;
  }

  const std::vector<std::int32_t>& count() const { return count_; }

 private:
  void Grow(std::int32_t size) {
    while (static_cast<std::int32_t>(onward_.size()) < size) onward_.push_back(static_cast<std::int32_t>(onward_.size()));
    count_.resize(size, 0);
  }

  std::vector<std::int32_t> onward_;  // a packet with room points at itself
  std::vector<std::int32_t> count_;
};

}  // namespace

PacketOrder PacketScheduler::Order(std::span<const std::int32_t> contacts, std::span<const std::int32_t> a,
                                   std::span<const std::int32_t> b) {
  std::vector<std::int32_t> packet(contacts.size());
  RoomFinder room;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    std::int32_t& after_a = earliest_[a[contacts[k]]];
    std::int32_t& after_b = earliest_[b[contacts[k]]];
    packet[k] = room.FirstWithRoom(std::max(after_a, after_b));
    room.Fill(packet[k]);
    if (inverse_mass_[a[contacts[k]]] > 0.0) after_a = packet[k] + 1;
    if (inverse_mass_[b[contacts[k]]] > 0.0) after_b = packet[k] + 1;
  }
  for (const std::int32_t c : contacts) earliest_[a[c]] = earliest_[b[c]] = 0;

  PacketOrder order;
  order.begin.push_back(0);
  for (const std::int32_t n : room.count()) {
    if (n > 0) order.begin.push_back(order.begin.back() + n);
  }
  // A packet takes its contacts in the order given: counting sort.
  std::vector<std::int32_t> place(order.begin.begin(), order.begin.end());
  order.contact.resize(contacts.size());
  for (std::size_t k = 0; k < contacts.size(); ++k) order.contact[place[packet[k]]++] = contacts[k];
  return order;
}

}  // namespace nscdd
