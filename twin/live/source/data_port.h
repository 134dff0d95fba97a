#pragma once
#include "twin/live/queue/sample_queue.h"
#include "twin/live/source/line_session.h"
#include <memory>
#include <string>

namespace mill::live {
struct DataPortSettings {
  std::string address = "127.0.0.1";  ///< literal; any but a loopback one needs rules.token
  int port            = 8461;         ///< 0: any that is free
  SourceRules rules;
};

/// Takes JSON lines by TCP and answers each: {"millstand":1,"next":s} to a head, {"ack":s} to a block once it is
/// in the queue, {"rejected":"..","line":n} to what is refused.  A full queue stops the reading (back-pressure).
/// One thread.  Limits: 4 clients, of which one sends; 5 s for the head, for a line that was begun and for an
/// answer that is not taken; five bad lines in a row, or a first line that is not a head, end the connection, as
/// does a minute without a sign of life from the machine of the client.
class DataPort {
public:
  /// Listens when it returns.
  /// @throws InputError  not a literal address, not an address of this machine, taken, not loopback and without a
  /// token
  DataPort(const DataPortSettings &settings, SampleQueue &queue);
  ~DataPort();  ///< closes every connection
  DataPort(const DataPort &)            = delete;
  DataPort &operator=(const DataPort &) = delete;
  int port() const;
  bool has_sender() const;     ///< a client whose head was taken is connected; any thread
  std::string notice() const;  ///< what has to be said of an address that is not loopback; empty otherwise

  struct State;  // of the source file
private:
  std::unique_ptr<State> state_;
};
}  // namespace mill::live
