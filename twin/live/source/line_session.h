#pragma once
#include "twin/live/queue/messages.h"
#include "twin/live/source/line_content.h"
#include "twin/records/raw_record.h"
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace mill::live {
/// What a source may say.
struct SourceRules {
  std::vector<std::string> places;  ///< of the model
  twin::ReadOptions reading;        ///< names, units and zone that the user gave
  std::string token;                ///< that a head has to bring; empty: none
  bool closes = true;               ///< five bad lines in a row end the connection
  /// Number that a sender with this head gives the sample for which the twin waits; nothing: another record
  /// begins.
  std::function<std::optional<std::int64_t>(const SourceHead &)> next;
  /// s, steady.  Given where lines of several senders cannot be distinguished: then a second one that sends a head
  /// while the first sends is refused.  None: heads follow each other.
  std::function<double()> clock;
  std::optional<SourceHead> assumed;  ///< of before a restart, for a sender that will not say it again
};

/// Head of a source from names and units as it writes them.
struct NamedUnit {
  std::string name, unit;
};
/// Channels in SI and what numbers are multiplied with.
struct KnownChannels {
  std::vector<LiveChannel> channels;
  std::vector<double> factor;  ///< -, SI value over the number sent
};
/// @throws InputError  no force, a unit that is not known or does not fit, a channel named twice: sentences
/// without a place
KnownChannels known_channels(const std::vector<NamedUnit> &sent, const SourceRules &rules);

/// Lines of one connection: its head, then blocks.  Nothing here reads or writes.
class LineSession {
public:
  explicit LineSession(SourceRules rules);

  struct Answer {
    std::optional<Message> message;
    std::string reply;   ///< a line for the sender, without its end; empty: none
    bool close = false;  ///< the connection ends after the reply
  };
  Answer take(std::string_view line);
  bool has_head() const
  {
    return head_.has_value();
  }

private:
  Answer head(const LineContent &content);
  Answer block(const LineContent &content);
  Answer refuse(std::string reason, std::int64_t first = 0, std::int64_t n = 0);

  SourceRules rules_;
  std::optional<SourceHead> head_;
  std::int64_t lines_ = 0, last_end_ = -1;
  double last_block_ = -std::numeric_limits<double>::infinity();  // s, steady
  int bad_in_a_row_  = 0;
};

/// Cuts a stream of bytes into lines; one that is longer than the limit comes out as far as the limit and a byte.
class LineCutter {
public:
  /// Calls visit(std::string_view) for each whole line, without its end.
  template <class Visit> void add(std::string_view bytes, Visit visit)
  {
    while (!bytes.empty()) {
      const auto end  = bytes.find('\n');
      const auto part = bytes.substr(0, end);
      const auto room = line_limits.bytes + 1 - rest_.size();  // bytes beyond the limit are dropped
      rest_.append(part.substr(0, room));
      if (end == std::string_view::npos)
        return;
      std::string line = std::move(rest_);
      rest_.clear();
      if (!line.empty() && line.back() == '\r')
        line.pop_back();
      visit(std::string_view(line));
      bytes.remove_prefix(end + 1);
    }
  }
  const std::string &rest() const
  {
    return rest_;
  }

private:
  std::string rest_;
};
}  // namespace mill::live
