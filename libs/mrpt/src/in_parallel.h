// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace vmcl {

/// Does all of `count` in as many parts as there are threads; part(first, size). Where no more threads are to be had,
/// fewer do it. Rethrows what a part threw, when all have ended.
void inParallel(std::size_t threads, std::size_t count, const std::function<void(std::size_t, std::size_t)>& part);

}  // namespace vmcl
