#include "twin/web/server/event_frames.h"
#include <algorithm>
#include <nlohmann/json.hpp>

namespace mill::web {
namespace {
constexpr std::size_t kept_frames  = 200;
constexpr std::size_t most_open    = 1000;  // of one kind: the memory has an end whatever is published
constexpr std::size_t most_waiting = 400;
constexpr int waiting_of_a_kind    = 2;

}  // namespace

FramePointer FrameStore::add(const std::string &event, const std::string &json)
{
  auto frame          = std::make_shared<EventFrame>();
  frame->event        = event;
  frame->display      = kinds_.whole.count(event) == 0;
  frame->text         = "id: " + std::to_string(++last_id_) + "\nevent: " + event + "\ndata: ";
  const auto position = frame->text.size();
  frame->text += json;
  // A line end would end the data; in JSON it can only stand between values.
  std::replace_if(
      frame->text.begin() + std::ptrdiff_t(position), frame->text.end(),
      [](const char c) { return c == '\n' || c == '\r'; }, ' ');
  frame->text += "\n\n";
  if (kinds_.history.count(event) > 0) {
    const auto data = nlohmann::json::parse(json, nullptr, false);
    if (data.is_object() && data.contains("id"))
      frame->about = data["id"].dump();
    frame->over = !kinds_.over || !data.is_object() || kinds_.over(data);
    keep(frame);
  } else {
    latest_[event] = {last_id_, frame};
  }
  return frame;
}

// What changes often does not push out what was said once, and what is over goes before what is not.
void FrameStore::keep(const FramePointer &frame)
{
  auto &kept = kept_[frame->event];
  if (!frame->about.empty()) {
    const auto before =
        std::find_if(kept.begin(), kept.end(), [&](const Numbered &k) { return k.second->about == frame->about; });
    if (before != kept.end())
      kept.erase(before);
  }
  kept.emplace_back(last_id_, frame);
  if (kept.size() <= kept_frames)
    return;
  auto goes = std::find_if(kept.begin(), kept.end(), [](const Numbered &k) { return k.second->over; });
  if (goes == kept.end()) {
    if (kept.size() <= most_open)
      return;
    goes = kept.begin();
  }
  kept.erase(goes);
  ++forgotten_;
}

std::int64_t FrameStore::forgotten() const
{
  return forgotten_;
}

std::vector<FramePointer> FrameStore::present_state() const
{
  std::map<std::int64_t, FramePointer> ordered;
  for (const auto &[event, kept] : kept_)
    ordered.insert(kept.begin(), kept.end());
  for (const auto &entry : latest_)
    ordered.insert(entry.second);
  std::vector<FramePointer> out;
  for (const auto &entry : ordered)
    out.push_back(entry.second);
  return out;
}

void FrameQueue::push(const FramePointer &frame)
{
  if (!frame->about.empty()) {
    const auto before = std::find_if(waiting_.begin(), waiting_.end(), [&](const FramePointer &other) {
      return other->event == frame->event && other->about == frame->about;
    });
    if (before != waiting_.end())
      waiting_.erase(before);
  }
  waiting_.push_back(frame);
  if (!frame->display)
    return;
  const auto same = [&](const FramePointer &other) { return other->event == frame->event; };
  if (std::count_if(waiting_.begin(), waiting_.end(), same) > waiting_of_a_kind) {
    waiting_.erase(std::find_if(waiting_.begin(), waiting_.end(), same));
    ++dropped_;
  }
}

std::vector<FramePointer> FrameQueue::take()
{
  std::vector<FramePointer> out(waiting_.begin(), waiting_.end());
  waiting_.clear();
  return out;
}

bool FrameQueue::empty() const
{
  return waiting_.empty();
}

std::int64_t FrameQueue::dropped() const
{
  return dropped_;
}

bool FrameQueue::overfull() const
{
  return waiting_.size() > most_waiting;
}
}  // namespace mill::web
