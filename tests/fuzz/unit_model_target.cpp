// model.json and force.csv in the resources of an exported unit: read, and stepped where they are accepted.
#include "dynamics/fmu/runtime/instance.h"
#include "dynamics/fmu/runtime/model_data.h"
#include "tests/fuzz/fuzz_file.h"
#include "tests/fuzz/quiet_log.h"
#include <stdexcept>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  std::string rest       = text_of(data, size);
  const std::string json = next_part(rest);
  fuzz_file("model.json", json);
  fuzz_file("force.csv", rest);
  try {
    const std::string token = mill::fmu::read_model(json).guid;
    mill::fmu::Instance unit(fuzz_folder() + "/", token, std::make_unique<QuietLog>(), 3);
    unit.set_up("", 0, false, 0);
    unit.enter_initialization("");
    unit.exit_initialization("");
    for (const double from : {0., 1e-4})
      if (unit.may_step("", from, 1e-4) == mill::fmu::Status::ok)
        unit.do_step("", from, 1e-4);
  } catch (const std::runtime_error &) {
  }
  return 0;
}
