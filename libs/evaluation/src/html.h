// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>

namespace vmcl {

/// As text of a page.
std::string escaped(const std::string& text);

/// As one word of a shell's command line.
std::string shellWord(const std::string& word);

/// gnuplot's file as an element of a page, its ids unlike those of other pictures there.
std::string inlineSvg(std::string svg, const std::string& prefix);

/// To the begin of <main>.
void writePageHead(std::ostream& out, const std::string& title);

}  // namespace vmcl
