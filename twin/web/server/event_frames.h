#pragma once
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

namespace mill::web {
/// One server-sent event as it goes over the line, shared by all browsers.
struct EventFrame {
  std::string event;
  std::string text;     ///< "id: 17\nevent: numbers\ndata: {...}\n\n"
  bool display = true;  ///< a newer one of its kind says all that this one says
  std::string about;  ///< of a history its member "id": a newer one about the same replaces it; empty: it has none
  bool over = true;   ///< of a history: it asks for nothing any more, so that it may be forgotten
};
using FramePointer = std::shared_ptr<const EventFrame>;

/// How the events of a page are kept and dropped, by their names.
struct EventKinds {
  std::set<std::string> whole;    ///< never dropped; all others are display: a newer one replaces an older one
  std::set<std::string> history;  ///< kept not the latest alone: of each kind the last 200, of one "id" the latest
  /// Of the data of a history: it is over.  Those that are not stay, up to 1000 of a kind.  Null: all are over.
  bool (*over)(const nlohmann::json &data) = nullptr;
};

/// Makes frames and keeps those that a new browser needs.
class FrameStore {
public:
  explicit FrameStore(EventKinds kinds) : kinds_(std::move(kinds)) {}
  FramePointer add(const std::string &event, const std::string &json);
  /// The latest of each kind, and what is kept of each history, in the order in which they came.
  std::vector<FramePointer> present_state() const;
  /// How many of the histories are not kept any more.
  std::int64_t forgotten() const;

private:
  using Numbered = std::pair<std::int64_t, FramePointer>;
  void keep(const FramePointer &frame);

  EventKinds kinds_;
  std::int64_t last_id_ = 0, forgotten_ = 0;
  std::map<std::string, Numbered> latest_;
  std::map<std::string, std::deque<Numbered>> kept_;
};

/// What waits for one browser: of each kind of display frame the two latest, of a history the latest about each
/// "id", of the others all.
class FrameQueue {
public:
  void push(const FramePointer &frame);
  /// Everything that waits, in order; the queue is empty then.
  std::vector<FramePointer> take();
  bool empty() const;
  std::int64_t dropped() const;
  /// More than 400 frames that may not be dropped wait: the browser has to connect again.
  bool overfull() const;

private:
  std::deque<FramePointer> waiting_;
  std::int64_t dropped_ = 0;
};
}  // namespace mill::web
