// SPDX-License-Identifier: BSD-3-Clause
#include "html.h"

#include <algorithm>

namespace vmcl {
namespace {

constexpr const char* style_sheet = R"(
body { font: 15px/1.5 system-ui, sans-serif; color: #222; background: #fff; margin: 0; }
main { max-width: 1120px; margin: 0 auto; padding: 1.5rem; }
h1 { font-size: 1.7rem; margin: 0 0 .5rem; }
h2 { font-size: 1.25rem; margin: 2.5rem 0 .7rem; border-bottom: 2px solid #0072b2; padding-bottom: .2rem; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; display: block; overflow-x: auto; }
th, td { padding: .25rem .7rem; text-align: right; border-bottom: 1px solid #e3e3e3; vertical-align: top; }
th { background: #f3f6f8; font-weight: 600; vertical-align: bottom; }
td:first-child, th:first-child { text-align: left; }
.words td { text-align: left; }
.words td:first-child { white-space: nowrap; }
.overview { font-size: .85rem; }
.overview td:nth-child(2) { text-align: left; }
.overview td:first-child { white-space: nowrap; }
tr.first td { border-top: 2px solid #c8d2d8; }
small { color: #777; white-space: nowrap; }
span { color: #777; font-weight: normal; }
em { color: #c0392b; font-style: normal; }
figure { margin: 1.2rem 0; }
figure svg { width: 100%; height: auto; }
figcaption { color: #555; font-size: .9rem; }
pre { background: #f6f6f6; padding: .8rem; overflow-x: auto; }
code { white-space: pre-wrap; word-break: break-word; font-size: .85rem; }
)";

void replaceAll(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string result = text;
  replaceAll(result, "&", "&amp;");
  replaceAll(result, "<", "&lt;");
  replaceAll(result, ">", "&gt;");
  replaceAll(result, "'", "&#39;");
  replaceAll(result, "\"", "&quot;");
  return result;
}

std::string shellWord(const std::string& word) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) || std::string_view("_-./=:,+").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string text = word;
  replaceAll(text, "'", "'\\''");
  return std::string("'").append(text).append("'");
}

std::string inlineSvg(std::string svg, const std::string& prefix) {
  svg.erase(0, svg.find("<svg"));
  for (const char* reference : {"id=\"", "id='", "href='#", "href=\"#", "url(#"})
    replaceAll(svg, reference, std::string(reference) + prefix);
  return svg;
}

void writePageHead(std::ostream& out, const std::string& title) {
  out << "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8>\n<meta name=viewport "
         "content='width=device-width'>\n<title>"
      << escaped(title) << "</title>\n<style>" << style_sheet << "</style></head>\n<body><main>\n<h1>" << escaped(title)
      << "</h1>\n";
}

}  // namespace vmcl
