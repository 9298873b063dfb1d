/// @file train_model: part file in, model file out.
#include "ppf_bin_picking/io/file_bytes.hpp"
#include "ppf_bin_picking/io/model_io.hpp"

#include "tool_support.hpp"

int main(int argc, char** argv)
{
  using namespace ppf_bin_picking;
  CLI::App app("Trains the model of a part, once, and writes it to a file.", "train_model");
  PartOptions part_options;
  std::string output;
  part_options.add(app);
  app.add_option("--output", output, "Model file to write, .ppf")->required();
  return runTool(app, argc, argv,
                 [&]
                 {
                   requireWritable(output);
                   const ToolPart part = part_options.load(output);
                   saveModel(output, trainedModel(part), part.mesh_checksum);
                   report("wrote " + output);
                 });
}
