#include "sensor_params.hpp"

#include "ppf_bin_picking/io/input_error.hpp"
#include "ppf_bin_picking/io/key_check.hpp"

#include <stdexcept>
#include <type_traits>

namespace ppf_bin_picking
{
namespace
{
DepthSensor preset(const YamlMap& map)
{
  const std::string name = map.has("preset") ? map.text("preset") : "industrial";
  try
  {
    return sensorPreset(name);
  }
  catch (const std::invalid_argument& error)
  {
    const std::string similar = similarName(name, sensorPresetNames());
    throw InputError(map.where() + ": preset: " + error.what() +
                     (similar.empty() ? "" : "; the nearest is '" + similar + "'"));
  }
}
}  // namespace

std::vector<std::string> depthSensorKeys()
{
  std::vector<std::string> keys = {"preset"};
  visitSensorFields(DepthSensor(), [&](const char* name, const auto&, double, double)
                    { keys.emplace_back(name); });
  return keys;
}

DepthSensor readDepthSensor(const YamlMap& map)
{
  DepthSensor sensor = preset(map);
  visitSensorFields(sensor,
                    [&](const char* name, auto& field, double, double)
                    {
                      using Field = std::decay_t<decltype(field)>;
                      if (!map.has(name)) return;
                      if constexpr (std::is_same_v<Field, int>)
                        field = map.integer(name);
                      else
                        field = static_cast<Field>(map.number(name));
                    });
  std::string problems;
  for (const std::string& problem : sensor.problems())
    problems += (problems.empty() ? ": " : "; ") + problem;
  if (!problems.empty()) throw InputError(map.where() + problems);
  return sensor;
}
}  // namespace ppf_bin_picking
