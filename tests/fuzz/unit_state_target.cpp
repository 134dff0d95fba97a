// A serialised state of an exported unit: as it stands, and with the mark and the hash that fit.  A state that is
// accepted is restored, and steps follow.  The first byte chooses the model.
#include "dynamics/fmu/runtime/instance.h"
#include "dynamics/fmu/runtime/model_data.h"
#include "dynamics/fmu/runtime/resources.h"
#include "tests/fuzz/fuzz_file.h"
#include "tests/fuzz/quiet_log.h"
#include <cstring>

namespace {
namespace fmu = mill::fmu;

std::unique_ptr<fmu::Instance> started(const std::string &folder)
{
  const std::string token = fmu::read_model(fmu::read_file(folder + "model.json")).guid;
  auto unit               = std::make_unique<fmu::Instance>(folder, token, std::make_unique<QuietLog>(), 3);
  unit->set_up("", 0, false, 0);
  unit->enter_initialization("");
  unit->exit_initialization("");
  unit->do_step("", 0, 1e-4);
  return unit;
}

std::string state_of(const fmu::Instance &unit)
{
  void *copy       = nullptr;
  std::size_t size = 0;
  unit.copy("", &copy);
  unit.serialized_size("", copy, &size);
  std::string bytes(size, '\0');
  unit.serialize("", copy, bytes.data(), size);
  unit.free_copy("", &copy);
  return bytes;
}

void try_state(fmu::Instance &unit, const std::string &bytes)
{
  void *copy = nullptr;
  if (unit.deserialize("", bytes.data(), bytes.size(), &copy) == fmu::Status::ok) {
    try {
      if (unit.restore("", copy) == fmu::Status::ok) {
        const double time = unit.time();
        if (unit.may_step("", time, 1e-4) == fmu::Status::ok)
          unit.do_step("", time, 1e-4);
        std::vector<fmu::Reference> all{1};
        double value;
        unit.get("", all.data(), 1, &value);
      }
    } catch (const std::runtime_error &) {
    }
    unit.free_copy("", &copy);
  }
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  if (size == 0)
    return 0;
  constexpr std::size_t head          = 8 + 3 * sizeof(std::uint64_t);
  static const auto chatter           = started(std::string(MILL_UNIT_FOLDER) + "chatter/");
  static const auto chain             = started(std::string(MILL_UNIT_FOLDER) + "chain/");
  static const std::string of_chatter = state_of(*chatter), of_chain = state_of(*chain);
  fmu::Instance &unit      = data[0] % 2 ? *chain : *chatter;
  const std::string &state = data[0] % 2 ? of_chain : of_chatter;
  if (std::getenv("MILL_FUZZ_SEED"))  // what this unit writes, to begin a corpus
    fwrite(state.data() + head, 1, state.size() - head, stdout);
  const std::string body = text_of(data + 1, size - 1);
  try_state(unit, body);
  std::uint64_t number[3];
  std::memcpy(number, state.data() + 8, sizeof number);
  number[1] = body.size();
  number[2] = 14695981039346656037u;
  for (const char byte : body)
    number[2] = (number[2] ^ std::uint64_t(static_cast<unsigned char>(byte))) * 1099511628211u;
  std::string forged = state.substr(0, head) + body;
  std::memcpy(&forged[8], number, sizeof number);
  try_state(unit, forged);
  try_state(unit, state);  // back to where the next input begins
  return 0;
}
