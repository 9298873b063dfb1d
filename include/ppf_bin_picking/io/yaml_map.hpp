/// @file Strict reading of YAML: every key known, every value of the type it should have.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

namespace ppf_bin_picking
{
/// Parses one YAML file of at most 1 MiB.
/// @throw InputError if it cannot be read or is not YAML; the line is named.
YAML::Node loadYaml(const std::string& path);

/// A mapping of which every key must be known. Numbers are those that YAML 1.1 (rosparam) and
/// yaml-cpp read alike, so that a file means the same to the node and to the command line: plain
/// decimals; an exponent only as in 2.0e-05.
class YamlMap
{
public:
  /// @param where  The file, and the key within it if nested; begins every message.
  /// @param keys   All keys that may stand here.
  /// @throw InputError if the node is not a mapping, a key is unknown or stands twice.
  YamlMap(const YAML::Node& node, std::string where, std::vector<std::string> keys);

  const std::string& where() const { return where_; }
  bool has(const std::string& key) const;

  /// Each reads the value of a key that must be there. @throw InputError naming the key, the value
  /// and what is expected.
  double number(const std::string& key) const;
  int integer(const std::string& key) const;
  bool boolean(const std::string& key) const;
  std::string text(const std::string& key) const;
  std::vector<double> numbers(const std::string& key, std::size_t count) const;
  YAML::Node node(const std::string& key) const;
  YamlMap map(const std::string& key, std::vector<std::string> keys) const;
  /// A list of mappings with the same keys; empty if the key is absent.
  std::vector<YamlMap> maps(const std::string& key, const std::vector<std::string>& keys) const;

private:
  YAML::Node node_;
  std::string where_;
  std::vector<std::string> keys_;
};

/// The shortest plain decimal, without exponent, that reads back as the same number.
/// @param value  Finite.
std::string plainDecimal(double value);
}  // namespace ppf_bin_picking
