// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace vmcl {

/// A mapping of a YAML file of which every key must be known. All errors are std::runtime_error naming file, line and
/// key; finish() refuses the keys nobody asked for.
class YamlMap {
 public:
  static YamlMap read(const std::filesystem::path& file);

  bool has(const std::string& key) { return static_cast<bool>(find(key)); }

  template <class T>
  T get(const std::string& key) {
    return as<T>(key, required(key));
  }
  template <class T>
  T get(const std::string& key, const T& fallback) {
    const YAML::Node node = find(key);
    return node ? as<T>(key, node) : fallback;
  }

  /// A number from `low` to `high`.
  double within(const std::string& key, double fallback, double low, double high);

  YamlMap map(const std::string& key) { return {required(key), file_, name(key)}; }

  /// The mappings of a list; none if the key is missing.
  std::vector<YamlMap> list(const std::string& key);

  /// A list of words.
  std::vector<std::string> texts(const std::string& key);

  /// A list of `size` finite numbers.
  std::vector<double> numbers(const std::string& key, std::size_t size);

  /// A list of lists of between `least` and `most` finite numbers each: points, or poses.
  std::vector<std::vector<double>> rows(const std::string& key, std::size_t least, std::size_t most);

  /// The keys of this mapping, for one whose keys are names.
  std::vector<std::string> keys() const;

  /// The directory of the file, for the files it names.
  std::filesystem::path directory() const { return std::filesystem::path(file_).parent_path(); }

  void finish() const;

  [[noreturn]] void fail(const std::string& key, const std::string& reason) const;

 private:
  YamlMap(const YAML::Node& node, const std::string& file, const std::string& name);
  YAML::Node find(const std::string& key);
  YAML::Node required(const std::string& key);
  std::string name(const std::string& key) const { return name_.empty() ? key : name_ + "." + key; }

  template <class T>
  T as(const std::string& key, const YAML::Node& node) const {
    T value;
    if (!YAML::convert<T>::decode(node, value)) fail(key, "has an unfit value");
    if constexpr (std::is_floating_point_v<T>)
      if (!std::isfinite(value)) fail(key, "is not finite");
    return value;
  }

  YAML::Node node_;
  std::string file_;
  std::string name_;
  std::set<std::string> asked_;
};

}  // namespace vmcl
