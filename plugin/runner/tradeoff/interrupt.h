#pragma once

namespace nscdd {

/// While it lives, Ctrl-C (SIGINT) and SIGTERM only raise a flag; a second signal ends the program as usual. One at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;
  bool raised() const;
};

}  // namespace nscdd
