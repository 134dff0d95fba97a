#pragma once
#include "core/base/errors.h"
#include "twin/records/record_units.h"
#include <Eigen/Core>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mill::twin {
/// One column of a record as it was read: NaN where the file has no number.
struct RawChannel {
  std::string name;    ///< place ("upper_work_roll"), "force", "speed", or the column's own name
  std::string column;  ///< as the file calls it
  std::string unit;    ///< SI: "m/s2", "N"; as in the file where the unit is unknown
  Quantity quantity = Quantity::other;
  bool unit_known   = false;  ///< `unit` is one that this program converts
  Place place;                ///< of the head of the column
  Eigen::VectorXd value;      ///< (n) in `unit`
};

/// Samples in which a column of texts says the same: a coil number, OK, TRUE.
struct LabelSpan {
  std::string column, text;
  Eigen::Index begin, end;  ///< samples begin .. end - 1
};

/// A record as it was read.  Nothing is repaired here.
struct RawRecord {
  std::string file;
  std::string format;                                      ///< "CSV", "UFF 58b", "numpy", "MATLAB 5", ..
  Eigen::VectorXd time;                                    ///< (n) s from the first sample; empty: even samples
  double rate = std::numeric_limits<double>::quiet_NaN();  ///< Hz, of even samples; NaN where `time` is there
  double first_time = 0;             ///< s, what the time column says at the first sample; 0: nothing, or a date
  std::optional<double> start;       ///< s since 1970-01-01 UTC of the first sample; none: the record has no date
  std::vector<RawChannel> channels;  ///< all of one length, at least one
  std::vector<LabelSpan> labels;     ///< by column, then by time
  std::vector<std::string> other_columns;  ///< columns that are not channels: the time, labels, those not used
  std::vector<std::string> notes;          ///< what the reader did to understand the file, one sentence each
  Place time_place;                        ///< of the head of the time column
  const RawChannel *find(const std::string &name) const;  ///< nullptr when absent
  Eigen::Index n_samples() const;
};

/// What the user says about records in addition to what the files say.
struct ReadOptions {
  std::optional<double> rate;                       ///< Hz, of records without a time column
  std::string zone;                                 ///< "Europe/Berlin", of local times; empty: none given
  std::string zone_folder = "/usr/share/zoneinfo";  ///< where the rules of the zones are
  std::map<std::string, std::string> channels;      ///< plant's name of a column -> place
  std::map<std::string, std::string> units;         ///< plant's name of a column -> unit, where the file has none
  std::map<std::string, std::string> scales;        ///< plant's name of a column -> "50 mV/g"; "": of all others
  std::vector<std::string> asked;                   ///< columns that --channel, --unit and --scale name
  bool several                = false;              ///< the options are for several records
  bool from_case              = false;  ///< a case names the record: there is no option that a remedy could name
  Eigen::Index fewest_samples = 2048;   ///< of a record; the default is what a spectrum needs
  std::string command;  ///< as it was typed, for a remedy that can be copied: "millstand analyse r.mat"
};

/// Reads a record by the ending of its name: .csv, .txt, .tsv, .asc, .dat in text; .npy with .json next to it;
/// .npz; .uff, .unv; .mat; .wav; .lvm.
/// @throws InputError with file:line:column and remedy
RawRecord read_record(const std::string &path, const ReadOptions &options);

/// Has this file one of the endings that read_record() knows?  Of .dat files those that begin as a text.
bool is_record_file(const std::string &path);

/// Is this a record in text, which can be read line by line?
bool is_csv_record(const std::string &path);

RawRecord read_csv_record(const std::string &path, const ReadOptions &options);
RawRecord read_npy_record(const std::string &path, const ReadOptions &options);
RawRecord read_npz_record(const std::string &path, const ReadOptions &options);
RawRecord read_uff_record(const std::string &path, const ReadOptions &options);
RawRecord read_mat_record(const std::string &path, const ReadOptions &options);
RawRecord read_wav_record(const std::string &path, const ReadOptions &options);
RawRecord read_lvm_record(const std::string &path, const ReadOptions &options);
}  // namespace mill::twin
