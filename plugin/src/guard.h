// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <exception>
#include <new>
#include <string>

#include "nscdd/error.h"
#include "nscdd_plugin.h"

namespace nscdd {

/// A null pointer, a truncated structure or a call in the wrong order: becomes NSCDD_BAD_CALL.
class BadCall : public Error {
 public:
  using Error::Error;
};

/// Something below the plugin failed (a host callback, MPI, arithmetic): becomes NSCDD_FAILED.
class Failure : public Error {
 public:
  using Error::Error;
};

inline void SetSentence(std::string* sentence, const char* text) noexcept {
  try {
    *sentence = text;
  } catch (...) {
    sentence->clear();  // no memory even for the sentence: the result alone must do
  }
}

/// Calls `function` and turns whatever it throws into a result and a sentence: nothing passes the C interface.
template <class Function>
std::int32_t Guard(std::string* sentence, Function&& function) noexcept {
  try {
    function();
    return NSCDD_OK;
  } catch (const BadCall& e) {
    SetSentence(sentence, e.what());
    return NSCDD_BAD_CALL;
  } catch (const Failure& e) {
    SetSentence(sentence, e.what());
  } catch (const Error& e) {
    SetSentence(sentence, e.what());
    return NSCDD_BAD_INPUT;
  } catch (const std::bad_alloc&) {
    SetSentence(sentence, "out of memory; use fewer bodies per process or more ranks");
  } catch (const std::exception& e) {
    SetSentence(sentence, e.what());
  } catch (...) {
    SetSentence(sentence, "something that is no std::exception was thrown inside the solver; please report it");
  }
  return NSCDD_FAILED;
}

}  // namespace nscdd
