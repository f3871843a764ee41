// SPDX-License-Identifier: Apache-2.0
#include "checkpoint/stop_signal.h"

#include <array>
#include <csignal>

namespace nscdd {
namespace {

constexpr std::array kSignals = {SIGTERM, SIGINT, SIGUSR1};

// A handler gets no pointer: what it notes must have a fixed place.
volatile std::sig_atomic_t noted = 0;
std::array<struct sigaction, kSignals.size()> before;

void RestoreAll() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &before[i], nullptr);
}

extern "C" void NoteStopSignal(int number) {
  noted = number;
  RestoreAll();
}

}  // namespace

StopSignal::StopSignal() {
  noted = 0;
  struct sigaction action {};
  action.sa_handler = NoteStopSignal;
  action.sa_flags = SA_RESTART;
  sigfillset(&action.sa_mask);
  for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], nullptr, &before[i]);
  for (const int signal : kSignals) ::sigaction(signal, &action, nullptr);
}

StopSignal::~StopSignal() { RestoreAll(); }

int StopSignal::received() const { return noted; }

}  // namespace nscdd
