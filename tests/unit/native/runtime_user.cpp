// SPDX-License-Identifier: MIT
// Routines in C++ that do not come back, as users write them.
#include <exception>
#include <stdexcept>
#include <vector>

extern "C" {
void fine() {}
void let_it_out() { throw std::runtime_error("nobody catches this"); }
void call_terminate() { std::terminate(); }

// Exceptions inside a routine are its own business.
void catch_it() {
  try {
    std::vector<int>(3).at(7) = 1;
  } catch (const std::out_of_range &) {
  }
}
}
