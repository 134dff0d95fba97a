#include "app/twin/live/live_recording.h"
#include "core/base/errors.h"
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;

namespace mill {
namespace {
const std::string &made_folder(const std::string &folder)
{
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder))
    refuse_file(error.value(), "the folder " + folder + " cannot be made" + (error ? ": " + error.message() : "") +
                                   "; choose another with --record");
  return folder;
}

live::RecorderSettings recorder_settings(const LiveOptions &options, const std::string &case_name,
                                         const std::string &case_hash)
{
  live::RecorderSettings settings;
  settings.folder    = options.record;
  settings.case_name = case_name;
  settings.case_hash = case_hash;
  if (!options.keep.empty())
    settings.kept = live::kept_records(options.keep);
  return settings;
}
}  // namespace

LiveRecording::LiveRecording(const LiveOptions &options, const std::string &case_name,
                             const std::string &case_hash, LiveConsole &console, live::AccountText account)
    : folder_(made_folder(options.record)), console_(console), lock_(folder_), state_(folder_),
      finished_(live::finish_parts(folder_, [&console](const std::string &text) { console.print(text + "\n"); })),
      recorder_(
          recorder_settings(options, case_name, case_hash), background_,
          [&console](const std::string &kind, const std::string &text) { console.say(kind, text); },
          std::move(account))
{
}

std::optional<nlohmann::json> LiveRecording::stored() const
{
  return state_.read([this](const std::string &why) { console_.print(why + "\n"); });
}

void LiveRecording::resume(const live::Engine &engine, const std::int64_t recorded, const std::string &file)
{
  if (engine.resumed_at() == 0) {
    for (const live::FinishedPart &part : finished_)
      if (part.source == file)
        recorder_.resume(part.next);
    return;
  }
  const auto some  = std::int64_t(120 * engine.source()->rate);  // a file is at most that long
  const auto known = recorded_up_to(folder_, *engine.source(), engine.resumed_at() - some);
  // a number ahead of every sample that was seen is wrong: nothing would be recorded up to it
  recorder_.resume(std::max(known.value_or(0), std::min(recorded, engine.resumed_at())));
}

void LiveRecording::store(const nlohmann::json &state)
{
  states_ += state_.write(state, background_,
                          [&console = console_](const std::string &why) { console.say("recording", why); });
}
}  // namespace mill
