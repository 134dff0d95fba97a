// The files of a detailed stand: matrices in the Matrix Market format and the tables of names and connections.
#include "core/base/errors.h"
#include "core/records/detailed_model.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  std::string rest = text_of(data, size);
  mill::ModelFiles files;
  files.mass      = fuzz_file("mass.mtx", next_part(rest));
  files.stiffness = fuzz_file("stiffness.mtx", next_part(rest));
  files.force     = fuzz_file("force.mtx", next_part(rest));
  files.readings  = fuzz_file("readings.mtx", next_part(rest));
  files.names     = fuzz_file("names.csv", next_part(rest));
  if (!rest.empty()) {
    files.connections = fuzz_file("connections.csv", next_part(rest));
    files.strains     = fuzz_file("strains.mtx", rest);
  }
  try {
    mill::detailed_model_of(files);
  } catch (const mill::InputError &) {
  }
  return 0;
}
