// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/random.h>

#include "vmcl/geometry/random.h"

namespace vmcl {

/// While it lives, what MRPT draws from the generator of the process follows from `random`; the generator is as before
/// afterwards. So a filter's draws depend on its own seed alone, whoever else draws in between.
class MrptDraws {
 public:
  explicit MrptDraws(Random& random) : before_(mrpt::random::getRandomGenerator()) {
    // As new: randomize() alone would keep the spare half of the last pair of normal numbers.
    mrpt::random::getRandomGenerator() = mrpt::random::CRandomGenerator(random.next());
  }
  ~MrptDraws() { mrpt::random::getRandomGenerator() = before_; }
  MrptDraws(const MrptDraws&) = delete;
  MrptDraws& operator=(const MrptDraws&) = delete;

 private:
  mrpt::random::CRandomGenerator before_;
};

}  // namespace vmcl
