// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace vmcl {

/// A path as a string of gnuplot's language.
std::string quoted(const std::filesystem::path& file);

/// Throws std::runtime_error naming the picture when gnuplot is missing or fails.
void runGnuplot(const std::filesystem::path& script, const std::filesystem::path& picture);

/// Draws what the commands plot, `size` ("900,600") in pixels, and puts the picture in place when it is whole. Throws
/// as runGnuplot does.
void drawSvg(const std::filesystem::path& svg, const std::string& size, const std::string& commands);

}  // namespace vmcl
