#include "tradeoff/interrupt.h"

#include <csignal>

namespace nscdd {
namespace {

volatile std::sig_atomic_t raised_signal = 0;  // a signal handler can reach nothing else

void Raise(int) { raised_signal = 1; }

void Handle(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

Interrupt::Interrupt() {
  raised_signal = 0;
  Handle(Raise);
}

Interrupt::~Interrupt() { Handle(SIG_DFL); }

bool Interrupt::raised() const { return raised_signal != 0; }

}  // namespace nscdd
