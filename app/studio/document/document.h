#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

// The case of a studio while it is edited: its text, what can be taken back, pinned states, and a journal that a
// kill at any moment leaves usable.
namespace mill::studio {
/// One change of a value.
struct Edit {
  std::string id;    ///< of the browser; an edit that arrives twice is done once
  std::string key;   ///< full
  std::string toml;  ///< value as TOML; empty: the line becomes a comment
};

/// One that a case cannot hold, and why.
struct RefusedEdit {
  std::string id, message;
};

/// A state that was kept under a name.
struct Pin {
  std::string name, text;
};

/// A run of the state with this text.
struct StoredRun {
  std::string id;    ///< name of its folder, "run-3"
  std::string text;  ///< of the case
};

struct DocumentState {
  long revision = 0;  ///< rises with every change of the text
  std::string text;
  bool saved       = true;         ///< the file holds this text
  std::size_t undo = 0, redo = 0;  ///< steps that can be taken
  std::vector<Pin> pins;
  std::vector<StoredRun> runs;
};

/// Every call may come from any thread.  A change is in the journal, on the disk, before the call returns.
class Document {
public:
  /// @param path        case file; where there is none a new case begins with `text_of_new()`
  /// @throws InputError, SystemError  the file cannot be read or the journal written; another studio works on it
  Document(std::string path, const std::function<std::string()> &text_of_new);
  ~Document();
  Document(const Document &)            = delete;
  Document &operator=(const Document &) = delete;

  const std::string &path() const;
  std::string notice() const;  ///< what was found at the start, a sentence; may be empty
  DocumentState state() const;

  /// Those that can be written are done, together one step of undo.
  /// @return  the others, in their order
  std::vector<RefusedEdit> set(const std::vector<Edit> &edits);
  void undo();
  void redo();
  void replace(const std::string &text);  ///< @throws InputError  not TOML
  /// Writes the file.  @throws InputError  somebody else has changed the file since; SystemError
  void save();
  void pin(const std::string &name);  ///< a pin of this name is replaced
  void unpin(const std::string &name);
  void back_to(const std::string &name);  ///< as replace() with the text of the pin
  void add_run(const StoredRun &run);

private:
  struct State;
  std::unique_ptr<State> state_;
};
}  // namespace mill::studio
