#include "twin/live/engine/engine.h"
#include "core/base/errors.h"
#include "twin/records/known_channel.h"
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mill::live {
namespace {
constexpr double joined              = 0.02;  // s of rows
constexpr double largest_value       = 1e20;  // SI; beyond it are the numbers by which instruments say "no value"
constexpr std::int64_t not_yet_known = std::numeric_limits<std::int64_t>::min();  // number of the next sample

bool same_channels(const std::vector<LiveChannel> &a, const std::vector<LiveChannel> &b)
{
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](const auto &x, const auto &y) {
           return x.name == y.name && x.unit == y.unit;
         });
}
}  // namespace

std::optional<std::int64_t> offset_of(const SourceHead &head, const LiveSource &source, const bool start_known)
{
  if (head.rate != source.rate || !same_channels(head.channels, source.channels))
    return {};
  if (!head.start || !start_known)
    return head.source == source.name ? std::optional<std::int64_t>(0) : std::nullopt;
  const double samples = (*head.start - source.start_time) * head.rate;
  // a quarter of a microsecond is what a date in seconds since 1970 resolves
  if (std::abs(samples - std::round(samples)) > 0.1 + 2.5e-7 * head.rate || std::abs(samples) > 1e15)
    return {};
  return std::llround(samples);
}

Engine::Engine(TwinModel model, EngineHooks hooks)
    : model_(std::move(model)), hooks_(std::move(hooks)), stand_(stepped(model_, tuning_)),
      places_(places_of(stand_))
{
  settling_time(stand_);
  TwinStepper(stand_, 1e4, 0);  // a stand that is not held is refused before any source is opened
}

void Engine::say(const std::string &kind, const std::string &text) const
{
  if (hooks_.reported)
    hooks_.reported(kind, text);
}

bool Engine::settling() const
{
  return stepped_ < settled_at_;
}

void Engine::take(Message message)
{
  if (const auto *head = std::get_if<SourceHead>(&message))
    take_head(*head);
  else if (const auto *block = std::get_if<SourceBlock>(&message))
    take_block(*block);
  else if (const auto *refused = std::get_if<RefusedLine>(&message)) {
    ++refused_lines_;
    if (book_ && refused->n > 0) {
      number_from(refused->first + offset_);
      book_->refuse(refused->first + offset_, refused->n);
    }
    say("refused", refused->reason);
  } else if (const auto *dropped = std::get_if<DroppedBlock>(&message)) {
    if (book_) {
      number_from(dropped->first + offset_);
      book_->overrun(dropped->first + offset_, dropped->n);
    }
    say("overrun",
        fmt::format("{} samples from s = {} were dropped: the queue was full", dropped->n, dropped->first));
  } else if (const auto *note = std::get_if<SourceNote>(&message))
    say(note->kind, note->text);
  else if (const auto *file = std::get_if<SourceFile>(&message))
    file_ = SourceFile{file->print, file->first + offset_};
  else if (const auto *end = std::get_if<SourceEnd>(&message)) {
    flush();
    ended_ = true;
    say("end", end->text);
  }
}

// Whether samples have said where the numbers of the source begin.
bool Engine::is_numbered() const
{
  return book_ && book_->begun() && book_->next() != not_yet_known;
}

// The first samples of a source say where its numbers begin.
void Engine::number_from(const std::int64_t first)
{
  if (!is_numbered())
    book_->renumber(first);
}

// Whether the numbers of a new connection go on those of the source before; `offset` is what ours are above its.
bool Engine::continues(const SourceHead &head, std::int64_t &offset) const
{
  if (!source_)
    return false;
  const auto above = offset_of(head, *source_, start_known_);
  if (!above || (*above != 0 && !is_numbered()))  // before the first sample another start is another source
    return false;
  offset = *above;
  return true;
}

void Engine::take_head(const SourceHead &head)
{
  flush();
  std::int64_t offset = 0;
  if (continues(head, offset)) {
    offset_      = offset;
    may_restart_ = true;
    say("source", fmt::format("source \"{}\" goes on", head.source));
    return;
  }
  begin_source(head);
}

void Engine::begin_source(const SourceHead &head)
{
  const bool same_account = source_ && same_channels(head.channels, source_->channels);
  start_known_            = head.start.has_value();
  source_ = LiveSource{head.source,   head.rate, head.start ? *head.start : hooks_.now ? hooks_.now() : 0,
                       head.channels, places_,   head.factor};
  file_.reset();
  impossible_.clear();
  offset_       = 0;
  may_restart_  = false;
  force_column_ = -1;
  for (std::size_t c = 0; c < head.channels.size(); ++c)
    if (twin::is_driving_force(head.channels[c].name))
      force_column_ = Eigen::Index(c);
  if (!same_account)
    book_.emplace(Eigen::Index(head.channels.size()));
  else
    book_->renumber(not_yet_known);
  stepper_ = std::make_unique<TwinStepper>(stand_, head.rate, 0);
  forget_  = -std::expm1(-1 / (head.rate * mean_over));
  lose();
  for (const auto &begun : hooks_.sources)
    begun(*source_);
  say("source",
      fmt::format("source \"{}\": {} channels at {:g} Hz", head.source, head.channels.size(), head.rate));
  if (force_column_ < 0)
    say("note",
        "no channel \"force\": the twin is not driven, and the accelerations alone are watched. If a column is "
        "the rolling force, name it with --channel NAME=force");
  else if (!stepper_->note().empty())
    say("note", stepper_->note());
}

// What was between the last sample and the next is not known.
void Engine::lose()
{
  stepping_ = false;
  waiting_.clear();
  n_waiting_ = 0;
}

// Samples between the last row that the twin has and this one: those that were not sent, and those that the book
// has already counted as refused or overrun.
Eigen::Index Engine::samples_before(const std::int64_t first, const AccountBook::Part &part) const
{
  if (part.take == 0 || (n_waiting_ == 0 && !stepping_))
    return part.gap;
  return Eigen::Index(first - (n_waiting_ > 0 ? first_waiting_ + n_waiting_ : stepped_));
}

void Engine::take_block(const SourceBlock &block)
{
  if (!book_ || block.value.cols() != Eigen::Index(source_->channels.size()))
    return;
  std::int64_t first = block.first + offset_;
  if (may_restart_ && book_->begun() && first + block.value.rows() <= book_->next() && !start_known_ &&
      double(book_->next() - first) > 60 * source_->rate) {
    say("source", fmt::format("the numbers begin again at s = {}: taken for a new record", block.first));
    flush();
    lose();
    offset_ = 0;
    first   = block.first;
    book_->renumber(first);
    source_->start_time = hooks_.now ? hooks_.now() - double(first) / source_->rate : 0;
    for (const auto &begun : hooks_.sources)
      begun(*source_);
  }
  may_restart_ = false;
  number_from(first);
  const AccountBook::Part part = book_->arrive(first, block.value.rows());
  const Eigen::Index gap       = samples_before(first + part.skip, part);
  if (gap > most_bridged || (gap > 0 && !stepping_ && n_waiting_ == 0)) {
    flush();
    lose();
    say("gap", fmt::format("{} samples before s = {} are missing", gap, first + part.skip));
  }
  if (part.take == 0) {
    tell_repetition(block);
    return;
  }
  repeated_             = 0;
  Eigen::MatrixXd fresh = block.value.bottomRows(part.take);
  first += part.skip;
  drop_impossible(first, fresh);
  if (hooks_.rows)
    hooks_.rows(first, fresh);
  book_->take(fresh);
  if (gap > 0 && (stepping_ || n_waiting_ > 0)) {  // so few that the force is drawn across
    if (n_waiting_ == 0)
      first_waiting_ = first - gap;
    waiting_.push_back(Eigen::MatrixXd::Constant(gap, fresh.cols(), std::numeric_limits<double>::quiet_NaN()));
    n_waiting_ += gap;
  }
  if (n_waiting_ == 0)
    first_waiting_ = first;
  waiting_.push_back(fresh);
  n_waiting_ += fresh.rows();
  if (double(n_waiting_) >= joined * source_->rate)
    flush();
}

// An instrument without a value sends 9.9e37 or its largest number.  One of them would leave the motion of the
// twin and the running means beyond all numbers from there on.
void Engine::drop_impossible(const std::int64_t first, Eigen::MatrixXd &rows)
{
  for (Eigen::Index c = 0; c < rows.cols(); ++c)
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      if (!(std::abs(rows(i, c)) > largest_value))
        continue;
      if (impossible_.insert(c).second)
        say("note", fmt::format("channel \"{}\" is {:.3g} at s = {}: a value beyond {:g} is not a measurement, it "
                                "is missing, as are further ones",
                                source_->channels[std::size_t(c)].name, rows(i, c), first + i, largest_value));
      rows(i, c) = std::numeric_limits<double>::quiet_NaN();
    }
}

// A minute of samples that were taken already is more than a repetition after a lost connection; it does not move
// the twin.
void Engine::tell_repetition(const SourceBlock &block)
{
  const auto minute           = std::llround(60 * source_->rate);
  const bool already_reported = repeated_ > minute;
  repeated_ += block.value.rows();
  if (!already_reported && repeated_ > minute)
    say("clock",
        fmt::format(
            "a minute of samples that were taken already has come again, up to s = {} where {} is the next: "
            "they count as doubled and move nothing. If the clock of the source was set back, let it send a "
            "head without \"start\", or start the twin with --fresh",
            block.first + block.value.rows(), book_->next() - offset_));
}

// Cuts the rows that wait where the force is missing for longer than two samples, draws it straight across fewer,
// and keeps the last rows while it is not known yet how long it is missing.
void Engine::flush()
{
  if (n_waiting_ == 0)
    return;
  Eigen::MatrixXd rows(n_waiting_, Eigen::Index(source_->channels.size()));
  Eigen::Index index = 0;
  for (const Eigen::MatrixXd &part : waiting_) {
    rows.middleRows(index, part.rows()) = part;
    index += part.rows();
  }
  const Eigen::Index n     = n_waiting_;
  const std::int64_t first = first_waiting_;
  waiting_.clear();
  n_waiting_ = 0;
  if (force_column_ < 0) {
    emit_without_force(first, rows);
    return;
  }
  Eigen::VectorXd force = rows.col(force_column_);
  Eigen::Index from     = 0;  // of the stretch that is not emitted yet
  const auto emit_up_to = [&](const Eigen::Index end) {
    if (end > from)
      emit(first + from, rows.middleRows(from, end - from), force.segment(from, end - from));
    from = end;
  };
  for (Eigen::Index i = 0; i < n;) {
    if (std::isfinite(force[i])) {
      ++i;
      continue;
    }
    Eigen::Index end = i;
    while (end < n && !std::isfinite(force[end]))
      ++end;
    const bool known = i > from || stepping_;
    if (known && end - i <= most_bridged) {
      if (end == n) {
        emit_up_to(i);
        first_waiting_ = first + i;
        n_waiting_     = n - i;
        waiting_.push_back(rows.bottomRows(n - i));
        return;
      }
      const double before = i > 0 ? force[i - 1] : stepper_->last_force();
      for (Eigen::Index k = i; k < end; ++k)
        force[k] = before + (force[end] - before) * (double(k - i + 1) / double(end - i + 1));
    } else {
      emit_up_to(i);
      from      = end;
      stepping_ = false;
    }
    i = end;
  }
  emit_up_to(n);
}

void Engine::emit(const std::int64_t first, const Eigen::MatrixXd &rows, const Eigen::VectorXd &force)
{
  const bool after_gap = !stepping_;
  if (after_gap)
    settled_at_ = first + std::llround(settling_time(stand_) * source_->rate);
  const Eigen::Index n       = rows.rows();
  const Eigen::Index settles = Eigen::Index(std::clamp<std::int64_t>(settled_at_ - first, 0, n));
  if (settles > 0)
    emit_part(first, rows.topRows(settles), force.head(settles), after_gap);
  if (settles < n)
    emit_part(first + settles, rows.bottomRows(n - settles), force.tail(n - settles), after_gap && settles == 0);
}

void Engine::emit_without_force(const std::int64_t first, const Eigen::MatrixXd &rows)
{
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  LiveBlock block;
  block.first        = first;
  block.rate         = source_->rate;
  block.start_time   = source_->start_time;
  block.after_gap    = !stepping_;
  block.driven       = false;
  block.force        = Eigen::VectorXd::Constant(rows.rows(), none);
  block.measured     = rows;
  block.simulated    = Eigen::MatrixXd::Constant(rows.rows(), Eigen::Index(places_.size()), none);
  block.displacement = Eigen::VectorXd::Zero(Eigen::Index(places_.size()));
  stepping_          = true;
  stepped_           = first + rows.rows();
  settled_at_        = first;
  for (const auto &observer : hooks_.observers)
    observer(block);
}

void Engine::emit_part(const std::int64_t first, const Eigen::Ref<const Eigen::MatrixXd> &rows,
                       const Eigen::Ref<const Eigen::VectorXd> &force, const bool after_gap)
{
  LiveBlock block;
  block.first      = first;
  block.rate       = source_->rate;
  block.start_time = source_->start_time;
  block.after_gap  = after_gap;
  block.settling   = first < settled_at_;
  block.force      = force;
  block.measured   = rows;
  block.simulated.resize(rows.rows(), Eigen::Index(places_.size()));
  Eigen::VectorXd a(block.simulated.cols());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    if (stepping_) {
      stepper_->advance(force[i]);
      mean_ += (force[i] - mean_) * forget_;
    } else {
      stepper_->rest_at(force[i]);
      mean_     = force[i];
      stepping_ = true;
    }
    stepper_->acceleration(a);
    block.simulated.row(i) = a.transpose();
    if (hooks_.motion)
      watch_motion(first + i);
  }
  stepped_           = first + rows.rows();
  block.displacement = stepper_->displacement_from(mean_);
  for (const auto &observer : hooks_.observers)
    observer(block);
}

void Engine::watch_motion(const std::int64_t number)
{
  constexpr Eigen::Index most = 256;
  if (number < motion_due_ && motion_due_ - number <= std::llround(source_->rate))
    return;
  const auto stride = std::max<std::int64_t>(1, std::llround(source_->rate / 4000));
  if (instants_ > 0 && number != motion_from_ + instants_ * stride) {
    if (number > motion_from_ + instants_ * stride || number < motion_from_)
      instants_ = 0;  // samples are missing in between
    return;
  }
  if (instants_ == 0) {
    motion_from_ = number;
    motion_.resize(Eigen::Index(places_.size()), most);
  }
  motion_.col(instants_++) = stepper_->displacement_from(mean_);
  if (instants_ < most)
    return;
  hooks_.motion(motion_from_, double(stride) / source_->rate, motion_);
  instants_   = 0;
  motion_due_ = motion_from_ + std::llround(source_->rate);
}

void Engine::apply(const PageCommand &command)
{
  flush();
  switch (command.kind) {
  case PageCommandKind::set:
    set_factor(tuning_, command.key, command.factor);
    say("command", fmt::format("{} is {:g} times the model's own", command.key, command.factor));
    change_model();
    break;
  case PageCommandKind::reset:
    if (command.key.empty())
      tuning_ = {};
    else
      set_factor(tuning_, command.key, 1);
    say("command",
        fmt::format("{} again as the model has it", command.key.empty() ? "everything is" : command.key));
    change_model();
    break;
  case PageCommandKind::adopt:
    if (auto adopted = hooks_.adopt ? hooks_.adopt(command.id) : std::nullopt) {
      model_  = std::move(*adopted);
      tuning_ = {};
      say("command", fmt::format("proposal {} is adopted", command.id));
      change_model();
    } else
      say("refused", fmt::format("no proposal {} is open", command.id));
    break;
  case PageCommandKind::acknowledge:
  case PageCommandKind::place:
  case PageCommandKind::advice:
    if (hooks_.others)
      hooks_.others(command);
    break;
  }
}

// The motion goes on about its present mean state: y is what the springs of the linear model see.  (48.3), (48.4)
void Engine::change_model()
{
  stand_ = stepped(model_, tuning_);
  if (stepper_) {
    if (stepping_)
      stepper_->refer_to(mean_);
    stepper_->change(stand_);
    settled_at_ = stepped_ + std::llround(settling_time(stand_) * source_->rate);
  }
  for (const auto &changed : hooks_.models)
    changed(model_, tuning_);
}
}  // namespace mill::live
