#pragma once
#include "app/command/command_line.h"
#include "app/studio/document/document.h"
#include "app/studio/jobs/jobs.h"
#include "app/trace/closed_form_chain.h"
#include "twin/web/server/page_server.h"
#include <future>
#include <map>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace mill::studio {
/// Files and routes of the page.
///   GET  /schema /document     rows of the case; its text, values, pins and runs
///   POST /edit                 {"op":"undo"|"redo"|"import"|"pin"|"unpin"|"back"|"hello", ..}
///   POST /check                {"edits":[{"id","key","value"}]}: takes the edits, answers as `millstand check`
///   POST /quick                closed forms, of a pin with {"pin"}; POST /sweep {"key","values"} of one key
///   POST /run                  {"what":"run"|"fmu"|"modelica"|"matlab"|"cancel"}
///   POST /save                 writes the case file; POST /compare {"pins":[a,b]}: as `millstand report A B`
///   GET  /run/ID/FILE          files of a run;  GET /events  "document", "run", "windows"
const web::PageTable &page_table();

/// The page of a case.
class Studio {
public:
  explicit Studio(const CommandLine &command);
  ~Studio();
  std::string url() const;
  std::string notice() const;

private:
  web::PageReply answer(const web::PageRequest &request);
  web::PageReply document() const;
  web::PageReply edit(const std::string &body);
  web::PageReply check(const std::string &body);
  web::PageReply quick(const std::string &body);
  web::PageReply sweep(const std::string &body);
  web::PageReply run(const std::string &body);
  web::PageReply save();
  web::PageReply compare(const std::string &body);
  web::PageReply file_of_run(const std::string &path) const;
  void import(const nlohmann::json &request);
  void publish_document(const std::string &by);
  void publish_job(const JobState &job);
  std::string kind_of_text(const std::string &text) const;

  const CommandLine command_;
  Document document_;
  const std::string folder_;  ///< of the runs
  std::mutex memory_access_;
  ClosedFormMemory memory_;
  std::mutex run_access_;  ///< one at a time begins a run
  Jobs jobs_;
  std::promise<void> open_;
  const std::shared_future<void> opened_ = open_.get_future();  // server_ has its value
  std::optional<web::PageServer> server_;
};
}  // namespace mill::studio
