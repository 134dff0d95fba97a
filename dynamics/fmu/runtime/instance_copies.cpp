#include "instance.h"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>

// Copies of the state in memory, and their serialised form: "MSTDFMU3", the mark of the model, the number of bytes
// that follow, their FNV-1a hash, then the members in a fixed order, numbers as the machine has them.
namespace mill::fmu {
namespace {
constexpr char magic[8]           = {'M', 'S', 'T', 'D', 'F', 'M', 'U', '3'};
constexpr std::size_t header_size = sizeof magic + 3 * sizeof(std::uint64_t);

/// What a client holds behind its pointer.
struct Copy {
  std::uint64_t mark;
  Snapshot state;
};

template <class IO> void each_number(IO &io, Snapshot &s)
{
  io.list(s.values);
  io.list(s.modes.q);
  io.list(s.modes.p);
  std::vector<double> z(2 * s.modes.z.size());
  for (std::size_t k = 0; k < s.modes.z.size(); ++k) {
    z[2 * k]     = s.modes.z[k].real();
    z[2 * k + 1] = s.modes.z[k].imag();
  }
  io.list(z);
  s.modes.z.resize(z.size() / 2);
  for (std::size_t k = 0; k < s.modes.z.size(); ++k)
    s.modes.z[k] = {z[2 * k], z[2 * k + 1]};
  io.list(s.vibration.z);
  for (double *number : {&s.vibration.next_step, &s.vibration.events, &s.force, &s.slope, &s.last_slope, &s.time,
                         &s.start, &s.stop})
    io.one(*number);
  for (bool *truth : {&s.has_stop, &s.input_set, &s.outputs_stale, &s.ended, &s.vibration.strip_held}) {
    std::uint64_t number = *truth ? 1 : 0;
    io.one(number);
    *truth = number != 0;
  }
  io.one(s.place);
  std::uint64_t phase = std::uint64_t(s.phase);
  io.one(phase);
  s.phase                  = phase <= std::uint64_t(Phase::failed) ? Phase(phase) : Phase::failed;
  std::uint64_t use_stored = std::uint64_t(s.use_stored);
  io.one(use_stored);
  s.use_stored = use_stored <= std::uint64_t(StoredForce::on) ? StoredForce(use_stored) : StoredForce::not_set;
}

class StateWriter {
public:
  template <class T> void one(const T &number)
  {
    const char *from = reinterpret_cast<const char *>(&number);
    bytes.insert(bytes.end(), from, from + sizeof number);
  }
  void list(const std::vector<double> &numbers)
  {
    one(std::uint64_t(numbers.size()));
    for (const double number : numbers)
      one(number);
  }
  std::vector<char> bytes;
};

class StateReader {
public:
  StateReader(const char *from, const std::size_t size) : at_(from), left_(size) {}
  template <class T> void one(T &number)
  {
    if (left_ < sizeof number) {
      complete = false;
      return;
    }
    std::memcpy(&number, at_, sizeof number);
    at_ += sizeof number;
    left_ -= sizeof number;
  }
  void list(std::vector<double> &numbers)
  {
    std::uint64_t n = 0;
    one(n);
    if (n > left_ / sizeof(double)) {
      complete = false;
      return;
    }
    numbers.resize(std::size_t(n));
    for (double &number : numbers)
      one(number);
  }
  bool at_end() const
  {
    return complete && left_ == 0;
  }

private:
  const char *at_;
  std::size_t left_;
  bool complete = true;
};

std::uint64_t check_of(const char *bytes, const std::size_t size)
{
  std::uint64_t hash = 14695981039346656037u;
  for (std::size_t i = 0; i < size; ++i)
    hash = (hash ^ std::uint64_t(static_cast<unsigned char>(bytes[i]))) * 1099511628211u;
  return hash;
}

std::vector<char> bytes_of(const Copy &copy)
{
  StateWriter writer;
  Snapshot state = copy.state;
  each_number(writer, state);
  return writer.bytes;
}
}  // namespace

Status Instance::copy(const char *function, void **state) const
{
  if (!state)
    return log_->refuse(Status::error, std::string(function) + ": a pointer is missing");
  if (now_.phase == Phase::intermediate)
    return log_->refuse(Status::error, std::string(function) + " is not allowed inside a step");
  if (!*state)
    *state = new Copy{mark_, now_};
  else if (is_copy(function, *state))
    static_cast<Copy *>(*state)->state = now_;
  else
    return Status::error;
  return Status::ok;
}

bool Instance::is_copy(const char *function, const void *state) const
{
  if (state && static_cast<const Copy *>(state)->mark == mark_)
    return true;
  log_->refuse(Status::error,
               std::string(function) + (state ? ": the state belongs to another model" : ": a state is missing"));
  return false;
}

Status Instance::restore(const char *function, const void *state)
{
  if (now_.phase == Phase::intermediate)
    return log_->refuse(Status::error, std::string(function) + " is not allowed inside a step");
  if (!is_copy(function, state))
    return Status::error;
  // The modes of a copy belong to its own parameters: nothing is to be carried over from the present ones.
  Snapshot wanted = static_cast<const Copy *>(state)->state;
  ModalState modes;
  std::swap(modes, wanted.modes);
  now_ = std::move(wanted);
  if (plays_series() && now_.phase != Phase::instantiated && now_.phase != Phase::set_up)
    load_series();
  if (now_.place > series_.time.size())
    now_.place = series_.before(now_.time, 0);
  use_parameters();
  std::swap(modes, now_.modes);
  return Status::ok;
}

Status Instance::free_copy(const char *function, void **state) const
{
  if (!state || !*state)
    return Status::ok;
  if (!is_copy(function, *state))
    return Status::error;
  static_cast<Copy *>(*state)->mark = 0;
  delete static_cast<Copy *>(*state);
  *state = nullptr;
  return Status::ok;
}

Status Instance::serialized_size(const char *function, const void *state, std::size_t *size) const
{
  if (!is_copy(function, state))
    return Status::error;
  if (!size)
    return log_->refuse(Status::error, std::string(function) + ": a pointer is missing");
  *size = header_size + bytes_of(*static_cast<const Copy *>(state)).size();
  return Status::ok;
}

Status Instance::serialize(const char *function, const void *state, char *bytes, const std::size_t size) const
{
  if (!is_copy(function, state))
    return Status::error;
  const std::vector<char> body = bytes_of(*static_cast<const Copy *>(state));
  if (!bytes || size < header_size + body.size())
    return log_->refuse(Status::error, std::string(function) + ": " + std::to_string(header_size + body.size()) +
                                           " bytes are needed, " + std::to_string(bytes ? size : 0) +
                                           " are there");
  const std::uint64_t head[] = {mark_, body.size(), check_of(body.data(), body.size())};
  std::memcpy(bytes, magic, sizeof magic);
  std::memcpy(bytes + sizeof magic, head, sizeof head);
  std::memcpy(bytes + header_size, body.data(), body.size());
  return Status::ok;
}

// Bytes with a hash that fits are whole, and not by that a state of this model: whoever wrote them may have made
// them.
bool Instance::may_hold(const Snapshot &state) const
{
  const auto finite = [](const std::vector<double> &numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](const double number) { return std::isfinite(number); });
  };
  if (state.values.size() != variables_.size() || state.phase == Phase::intermediate)
    return false;
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    const Variable &variable = variables_[i];
    const double value       = state.values[i];
    if (variable.has_start() && variable.type == Type::real &&
        !(std::isfinite(value) && (!variable.bounded() || (value >= variable.low && value <= variable.high))))
      return false;
  }
  if (model_.kind == StandKind::chain && !is_held(modal_system(model_, tuning_of(state.values))))
    return false;
  const ModalState &modes = state.modes;
  const auto &vibration   = state.vibration.z;
  const std::size_t n = model_.n_modes(), unknowns = 2 * n + 2;
  // From the first values on there is a motion.
  const bool moves = state.phase == Phase::step || state.phase == Phase::terminated ||
                     (state.phase == Phase::initialization && !state.outputs_stale);
  const bool chatter   = model_.kind == StandKind::chatter;
  const bool has_modes = modes.q.size() == n && !chatter, has_vibration = vibration.size() == unknowns;
  return modes.p.size() == modes.q.size() && (modes.q.empty() || has_modes) &&
         (vibration.empty() || (chatter && has_vibration)) &&
         (!moves || has_modes || (chatter && has_vibration)) && finite(modes.q) && finite(modes.p) &&
         finite(vibration) && std::isfinite(state.vibration.next_step) &&
         finite({state.time, state.start, state.force, state.slope, state.last_slope});
}

Status Instance::deserialize(const char *function, const char *bytes, const std::size_t size, void **state) const
{
  const std::string prefix = std::string(function) + ": ";
  if (!bytes || !state)
    return log_->refuse(Status::error, prefix + "a pointer is missing");
  std::uint64_t head[3] = {};
  if (size >= header_size)
    std::memcpy(head, bytes + sizeof magic, sizeof head);
  if (size < header_size || std::memcmp(bytes, magic, sizeof magic) != 0 || head[1] > size - header_size ||
      head[2] != check_of(bytes + header_size, std::size_t(head[1])))
    return log_->refuse(Status::error, prefix + "the bytes are not a serialised state, or they are damaged");
  if (head[0] != mark_)
    return log_->refuse(Status::error, prefix + "the state belongs to another model");
  auto made = std::make_unique<Copy>(Copy{mark_, {}});
  StateReader reader(bytes + header_size, std::size_t(head[1]));
  each_number(reader, made->state);
  if (!reader.at_end() || !may_hold(made->state))
    return log_->refuse(Status::error, prefix + "the bytes are not a serialised state, or they are damaged");
  if (*state) {
    if (!is_copy(function, *state))
      return Status::error;
    static_cast<Copy *>(*state)->state = made->state;
  } else
    *state = made.release();
  return Status::ok;
}
}  // namespace mill::fmu
