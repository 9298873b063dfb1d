#include "ppf_bin_picking/io/yaml_map.hpp"

#include "support/files.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace ppf_bin_picking
{
namespace
{
YamlMap mapOf(const std::string& value)
{
  return {YAML::Load("key: " + value), "f.yaml", {"key"}};
}

TEST(YamlMap, readsNumbersThatRosparamReadsAlike)
{
  EXPECT_EQ(mapOf("0.25").number("key"), 0.25);
  EXPECT_EQ(mapOf("-3").number("key"), -3.0);
  EXPECT_EQ(mapOf("+7.").number("key"), 7.0);
  EXPECT_EQ(mapOf("0").number("key"), 0.0);
  EXPECT_EQ(mapOf("2.0e-05").number("key"), 2.0e-05);
  EXPECT_EQ(mapOf("12").integer("key"), 12);
}

TEST(YamlMap, refusesNumbersThatRosparamReadsOtherwise)
{
  for (const char* value :
       {"1e-2", "2.0e5", "deg(12)", "rad(1)", "'0.5'",       "\"3\"",         ".nan",     ".inf",
        "nan",  "inf",   "1_000",   "0x10",   "010",         "1:30",          "true",     "",
        "~",    "1,5",   "[1]",     "{a: 1}", "!!float 1.0", "!degrees 12.0", "1.0e+400", ".5"})
  {
    SCOPED_TRACE(value);
    const std::string message = inputError([&] { mapOf(value).number("key"); });
    EXPECT_EQ(message.find("f.yaml: key is "), 0U) << message;
    expectHolds(message, "plain decimal number such as 0.35");
  }
  expectHolds(inputError([] { mapOf("1e-2").number("key"); }), "'1e-2'");
}

TEST(YamlMap, refusesBrokenWholeNumbers)
{
  for (const char* value : {"3.0", "2147483648", "-99999999999", "'3'", "three"})
    expectHolds(inputError([&] { mapOf(value).integer("key"); }), "give a whole number");
}

TEST(YamlMap, readsBooleansThatRosparamReadsAlike)
{
  for (const char* value : {"true", "True", "yes", "on"})
    EXPECT_TRUE(mapOf(value).boolean("key"));
  for (const char* value : {"false", "FALSE", "no", "Off"})
    EXPECT_FALSE(mapOf(value).boolean("key"));
  for (const char* value : {"y", "n", "'true'", "1", "maybe", "[]"})
    expectHolds(inputError([&] { mapOf(value).boolean("key"); }), "give true or false");
}

TEST(YamlMap, readsListsOfNumbersOfTheRightLength)
{
  EXPECT_EQ(mapOf("[1, 2.5, -3]").numbers("key", 3), (std::vector<double>{1, 2.5, -3}));
  expectHolds(inputError([] { mapOf("[1, 2]").numbers("key", 3); }), "key is a list of 2");
  expectHolds(inputError([] { mapOf("[1, 2, x]").numbers("key", 3); }), "key[2] is 'x'");
  expectHolds(inputError([] { mapOf("5").numbers("key", 3); }), "a list of 3 numbers");
}

TEST(YamlMap, refusesWhatIsNoMapping)
{
  for (const char* text : {"", "5", "[1, 2]", "text"})
    expectHolds(inputError([&] { YamlMap(YAML::Load(text), "f.yaml", {"key"}); }),
                "give 'key: value' lines");
}

TEST(YamlMap, refusesUnknownAndRepeatedKeys)
{
  expectHolds(inputError([] { YamlMap(YAML::Load("{kye: 1}"), "f.yaml", {"key"}); }),
              "unknown key 'kye': the nearest known name is 'key'");
  expectHolds(inputError([] { YamlMap(YAML::Load("{key: 1, key: 2}"), "f.yaml", {"key"}); }),
              "key stands there twice");
}

TEST(YamlMap, namesAMissingKey)
{
  const YamlMap map(YAML::Load("{}"), "f.yaml", {"key"});
  EXPECT_FALSE(map.has("key"));
  EXPECT_EQ(inputError([&] { map.number("key"); }), "f.yaml: key is missing: add it");
}

TEST(LoadYaml, namesTheLineOfAFault)
{
  const TemporaryFolder folder;
  expectHolds(inputError([&] { loadYaml(folder.write("f.yaml", "a: 1\nb: [1, 2\n")); }),
              "f.yaml: line 3 is not valid YAML (");
}

TEST(LoadYaml, refusesFilesThatAreNotThereOrTooLarge)
{
  const TemporaryFolder folder;
  expectHolds(inputError([&] { loadYaml(folder.file("none.yaml")); }), "does not exist");
  expectHolds(inputError([&] { loadYaml(folder.write("f/a.yaml", "") + "/.."); }),
              "check the path");
  const std::string large = folder.write("large.yaml", std::string((1 << 20) + 1, ' '));
  expectHolds(inputError([&] { loadYaml(large); }), "check that it is the file you mean");
}

TEST(LoadYaml, survivesHostileText)
{
  const TemporaryFolder folder;
  std::mt19937 rng(5);
  const std::string letters = "{}[]:,-&*!|>'\"%@# \n\tab01.\xff";
  for (int trial = 0; trial < 500; ++trial)
  {
    std::string text;
    for (int k = 0; k < 40; ++k)
      text += letters[rng() % letters.size()];
    try
    {
      const YamlMap map(loadYaml(folder.write("f.yaml", text)), "f.yaml", {"a"});
      map.number("a");
      ADD_FAILURE() << "read as a number: " << text;
    }
    catch (const InputError& error)
    {
      EXPECT_NE(std::string(error.what()).find("f.yaml"), std::string::npos);
    }
  }
}

TEST(PlainDecimal, readsBackAsTheSameNumber)
{
  EXPECT_EQ(plainDecimal(0.05), "0.05");
  EXPECT_EQ(plainDecimal(-3), "-3");
  EXPECT_EQ(plainDecimal(1e-9), "0.000000001");
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> uniform(-10, 10);
  for (int trial = 0; trial < 100; ++trial)
  {
    const double value = uniform(rng);
    EXPECT_EQ(std::stod(plainDecimal(value)), value);
  }
  EXPECT_THROW(plainDecimal(std::numeric_limits<double>::infinity()), std::invalid_argument);
}
}  // namespace
}  // namespace ppf_bin_picking
