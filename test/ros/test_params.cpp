#include "ppf_bin_picking/ros/params.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace ppf_bin_picking_ros
{
namespace
{
using ppf_bin_picking::DetectorConfig;
using XmlRpc::XmlRpcValue;

constexpr char kNode[] = "/cell/pose_detector";

XmlRpcValue minimalTree()
{
  XmlRpcValue tree;
  tree["parts"] = "/parts/pin.yaml";
  return tree;
}

XmlRpcValue numbers(const std::vector<double>& values)
{
  XmlRpcValue list;
  list.setSize(static_cast<int>(values.size()));
  for (int i = 0; i < list.size(); ++i)
    list[i] = values[static_cast<std::size_t>(i)];
  return list;
}

/// The complaints about a tree; empty if it is accepted.
std::vector<std::string> problemsOf(const XmlRpcValue& tree)
{
  try
  {
    readServerParams(tree, kNode);
  }
  catch (const ParamError& error)
  {
    return error.problems();
  }
  return {};
}

TEST(ReadServerParams, hasDefaultsForAllButTheParts)
{
  const ServerParams params = readServerParams(minimalTree(), kNode);
  EXPECT_EQ(params.parts, std::vector<std::string>{"/parts/pin.yaml"});
  EXPECT_EQ(params.output_frame, "");
  EXPECT_FALSE(params.region_of_interest);
  EXPECT_EQ(toYaml(params.detector), toYaml(DetectorConfig()));
}

TEST(ReadServerParams, readsEveryField)
{
  XmlRpcValue tree;
  tree["parts"][0] = "/a.yaml";
  tree["parts"][1] = "/b.yaml";
  tree["output_frame"] = "base_link";
  tree["timeout_s"] = 2;  // an integer passes for a double
  tree["tf_timeout_s"] = 0.25;
  tree["max_poses"] = 7;
  tree["diagnostic_period"] = 2.0;
  tree["detector"]["min_score"] = 1;
  tree["detector"]["eps_rel"] = 0.00001;
  tree["detector"]["threads"] = 3;
  tree["detector"]["mismatch_test"] = false;
  tree["detector"]["clustering"] = "greedy";
  tree["region_of_interest"]["frame"] = "bin";
  tree["region_of_interest"]["min"] = numbers({-0.1, -0.2, 0});
  tree["region_of_interest"]["max"] = numbers({0.1, 0.2, 0.3});
  const ServerParams params = readServerParams(tree, kNode);
  EXPECT_EQ(params.parts, (std::vector<std::string>{"/a.yaml", "/b.yaml"}));
  EXPECT_EQ(params.output_frame, "base_link");
  EXPECT_EQ(params.timeout_s, 2.0);
  EXPECT_EQ(params.tf_timeout_s, 0.25);
  EXPECT_EQ(params.max_poses, 7);
  EXPECT_EQ(params.detector.min_score, 1.0);
  EXPECT_EQ(params.detector.eps_rel, 0.00001);
  EXPECT_EQ(params.detector.threads, 3);
  EXPECT_FALSE(params.detector.mismatch_test);
  EXPECT_EQ(params.detector.clustering, ppf_bin_picking::Clustering::kGreedy);
  ASSERT_TRUE(params.region_of_interest);
  EXPECT_EQ(params.region_of_interest->frame, "bin");
  EXPECT_EQ(params.region_of_interest->region.max, Eigen::Vector3d(0.1, 0.2, 0.3));
}

struct BadTree
{
  const char* name;
  std::function<void(XmlRpcValue&)> spoil;
  const char* sentence;
};

void PrintTo(const BadTree& bad, std::ostream* stream)
{
  *stream << bad.name;
}

class WrongParameter : public testing::TestWithParam<BadTree>
{
};

TEST_P(WrongParameter, isNamedWithItsRemedy)
{
  XmlRpcValue tree = minimalTree();
  ASSERT_TRUE(problemsOf(tree).empty());
  GetParam().spoil(tree);
  const std::vector<std::string> problems = problemsOf(tree);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0], GetParam().sentence);
}

const BadTree kBadTrees[] = {
    {"misspeltKey", [](XmlRpcValue& t) { t["output_frme"] = "base"; },
     "/cell/pose_detector: unknown key 'output_frme': the nearest known name is 'output_frame'"},
    {"misspeltSetting", [](XmlRpcValue& t) { t["detector"]["lamda"] = 0.5; },
     "/cell/pose_detector/detector: unknown key 'lamda': the nearest known name is 'lambda'"},
    {"textForNumber", [](XmlRpcValue& t) { t["detector"]["min_score"] = "1e-2"; },
     "/cell/pose_detector/detector: min_score is '1e-2': give a plain decimal number such as 0.35, "
     "without quotes, exponent or deg()"},
    {"quotedNumber", [](XmlRpcValue& t) { t["timeout_s"] = "0.5"; },
     "/cell/pose_detector: timeout_s is '0.5': give a plain decimal number such as 0.35, without "
     "quotes, exponent or deg()"},
    {"doubleForInteger", [](XmlRpcValue& t) { t["detector"]["n_angle"] = 30.0; },
     "/cell/pose_detector/detector: n_angle is '30.0': give a whole number such as 30, without "
     "quotes"},
    {"integerForBoolean", [](XmlRpcValue& t) { t["detector"]["mismatch_test"] = 1; },
     "/cell/pose_detector/detector: mismatch_test is '1': give true or false, without quotes"},
    {"unknownWord", [](XmlRpcValue& t) { t["detector"]["clustering"] = "kmeans"; },
     "/cell/pose_detector/detector: clustering is 'kmeans': give dbscan or greedy"},
    {"outOfRange", [](XmlRpcValue& t) { t["detector"]["lambda"] = 1.5; },
     "/cell/pose_detector/detector: lambda is 1.5: give a value from 0 to 1"},
    {"negativeTimeout", [](XmlRpcValue& t) { t["timeout_s"] = -1.0; },
     "/cell/pose_detector: timeout_s is -1: give a value from 0.001 to 3600"},
    {"negativeCount", [](XmlRpcValue& t) { t["max_poses"] = -1; },
     "/cell/pose_detector: max_poses is -1: give 0 for all, or a number above"},
    {"emptyParts", [](XmlRpcValue& t) { (t["parts"] = XmlRpcValue()).setSize(0); },
     "/cell/pose_detector: parts is empty or no list: give a part file, or a list of them"},
    {"numberAmongParts", [](XmlRpcValue& t) { (t["parts"] = XmlRpcValue())[0] = 5; },
     "/cell/pose_detector: parts[0] is no text: give a part file, or a list of them"},
    {"relativePart", [](XmlRpcValue& t) { t["parts"] = "pin.yaml"; },
     "/cell/pose_detector: parts is 'pin.yaml': give an absolute path, or package://name/path"},
    {"partOfNoPackage", [](XmlRpcValue& t) { t["parts"] = "package://no_such_one/pin.yaml"; },
     "/cell/pose_detector: parts names the package 'no_such_one', which is not found: source the "
     "workspace that holds it, or give an absolute path"},
    {"detectorIsNoMapping", [](XmlRpcValue& t) { t["detector"] = 5; },
     "/cell/pose_detector/detector is '5': give 'key: value' lines"},
    {"regionInsideOut",
     [](XmlRpcValue& t)
     {
       t["region_of_interest"]["min"] = numbers({0, 0, 1});
       t["region_of_interest"]["max"] = numbers({1, 1, 0});
     },
     "/cell/pose_detector/region_of_interest: min is not below max: give two opposite corners [m], "
     "each of the three numbers of min less than that of max"},
    {"regionMisspelt",
     [](XmlRpcValue& t)
     {
       t["region_of_interest"]["min"] = numbers({0, 0, 0});
       t["region_of_interest"]["mx"] = numbers({1, 1, 1});
     },
     "/cell/pose_detector/region_of_interest: unknown key 'mx': the nearest known name is 'max'"},
};

INSTANTIATE_TEST_SUITE_P(Each, WrongParameter, testing::ValuesIn(kBadTrees),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(ReadServerParams, tellsAllProblemsAtOnce)
{
  XmlRpcValue tree;  // no parts
  tree["detector"]["lamda"] = 0.5;
  tree["detector"]["min_score"] = "high";
  tree["detector"]["v_min"] = 2.0;
  tree["outputframe"] = "base";
  tree["tf_timeout_s"] = -1;
  EXPECT_EQ(problemsOf(tree).size(), 6U);
}

TEST(ReadServerParams, refusesANodeWithoutAnyParameter)
{
  const std::vector<std::string> problems = problemsOf(XmlRpcValue());
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0],
            "/cell/pose_detector: parts is missing: give a part file, or a list of them");
}

TEST(ReadServerParams, agreesWithTheReaderOfFiles)
{
  DetectorConfig config;
  config.model.step_rel = 0.0375;
  config.min_score = 2.0 / 3.0;
  config.min_visible_share = 0.00001;
  config.threads = 2;
  config.clustering = ppf_bin_picking::Clustering::kGreedy;
  XmlRpcValue tree = minimalTree();
  const auto set = [&](const char* name, const auto& field)
  {
    if constexpr (std::is_same_v<decltype(field), const ppf_bin_picking::Clustering&>)
      tree["detector"][name] = toString(field);
    else
      tree["detector"][name] = field;
  };
  visitFields(config, set);
  const YAML::Node file = YAML::Load(toYaml(config));
  const DetectorConfig from_file = ppf_bin_picking::withSettings({}, file, "detector.yaml");
  EXPECT_EQ(toYaml(readServerParams(tree, kNode).detector), toYaml(from_file));
  EXPECT_EQ(toYaml(from_file), toYaml(config));
}
}  // namespace
}  // namespace ppf_bin_picking_ros
