// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/geometry/yaml_map.h"

#include <fstream>

namespace vmcl {
namespace {

constexpr std::uintmax_t max_file_bytes = 4 << 20;

std::string place(const std::string& file, const YAML::Mark& mark) {
  return mark.is_null() ? file : file + ":" + std::to_string(mark.line + 1);
}

}  // namespace

YamlMap YamlMap::read(const std::filesystem::path& file) {
  std::error_code error;
  std::ifstream in(file);
  if (!in || !std::filesystem::is_regular_file(file, error))
    throw std::runtime_error(file.string() + ": cannot be opened");
  if (std::filesystem::file_size(file) > max_file_bytes) throw std::runtime_error(file.string() + ": over 4 MiB");
  try {
    return {YAML::Load(in), file.string(), ""};
  } catch (const YAML::Exception& yaml_error) {
    throw std::runtime_error(place(file.string(), yaml_error.mark) + ": " + yaml_error.msg);
  }
}

YamlMap::YamlMap(const YAML::Node& node, const std::string& file, const std::string& name)
    : node_(node), file_(file), name_(name) {
  if (!node.IsMap())
    throw std::runtime_error(place(file, node.Mark()) + ": " + (name.empty() ? "the file" : name) +
                             " is not a mapping of keys to values");
}

YAML::Node YamlMap::find(const std::string& key) {
  asked_.insert(key);
  return static_cast<const YAML::Node&>(node_)[key];
}

YAML::Node YamlMap::required(const std::string& key) {
  const YAML::Node node = find(key);
  if (!node) fail(key, "is missing");
  return node;
}

double YamlMap::within(const std::string& key, double fallback, double low, double high) {
  const double value = get(key, fallback);
  if (!(value >= low && value <= high))
    fail(key, "is not between " + std::to_string(low) + " and " + std::to_string(high));
  return value;
}

std::vector<YamlMap> YamlMap::list(const std::string& key) {
  std::vector<YamlMap> maps;
  const YAML::Node node = find(key);
  if (!node) return maps;
  if (!node.IsSequence()) fail(key, "is not a list");
  for (std::size_t i = 0; i < node.size(); ++i)
    maps.push_back({node[i], file_, name(key) + "[" + std::to_string(i) + "]"});
  return maps;
}

std::vector<std::string> YamlMap::texts(const std::string& key) {
  const YAML::Node node = required(key);
  if (!node.IsSequence()) fail(key, "is not a list");
  std::vector<std::string> texts;
  for (const YAML::Node& item : node) texts.push_back(as<std::string>(key, item));
  return texts;
}

std::vector<double> YamlMap::numbers(const std::string& key, std::size_t size) {
  const YAML::Node node = required(key);
  if (!node.IsSequence() || node.size() != size) fail(key, "is not a list of " + std::to_string(size) + " numbers");
  std::vector<double> values;
  for (const YAML::Node& item : node) values.push_back(as<double>(key, item));
  return values;
}

std::vector<std::vector<double>> YamlMap::rows(const std::string& key, std::size_t least, std::size_t most) {
  const YAML::Node node = required(key);
  if (!node.IsSequence()) fail(key, "is not a list");
  std::vector<std::vector<double>> rows;
  for (const YAML::Node& item : node) {
    if (!item.IsSequence() || item.size() < least || item.size() > most)
      fail(key, "is not a list of lists of " + std::to_string(least) +
                    (most > least ? " to " + std::to_string(most) : "") + " numbers");
    rows.emplace_back();
    for (const YAML::Node& number : item) rows.back().push_back(as<double>(key, number));
  }
  return rows;
}

std::vector<std::string> YamlMap::keys() const {
  std::vector<std::string> keys;
  for (const auto& item : node_) keys.push_back(item.first.as<std::string>());
  return keys;
}

void YamlMap::finish() const {
  for (const auto& item : node_)
    if (const auto key = item.first.as<std::string>(); !asked_.contains(key)) fail(key, "is not a known key");
}

void YamlMap::fail(const std::string& key, const std::string& reason) const {
  const YAML::Node node = node_[key];
  throw std::runtime_error(place(file_, node ? node.Mark() : node_.Mark()) + ": " + name(key) + " " + reason);
}

}  // namespace vmcl
