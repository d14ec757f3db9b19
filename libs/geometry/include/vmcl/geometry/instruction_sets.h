// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Instruction sets to compile nothing for; read by Highway, so include it first. Vectors of SVE and RVV are sizeless
/// types, which no class can hold; few processors have SSSE3 and not SSE4.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
