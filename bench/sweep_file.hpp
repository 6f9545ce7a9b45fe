#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/results_folder.hpp"
#include "bench/sweep_plan.hpp"

namespace seam {

/// What a sweep's file holds. It lies beside the file as FILE.json, so that nothing is mixed with it that belongs to another sweep.
struct SweepContents {
  nlohmann::ordered_json subject;  // versions, scene, files with checksums, set: what was varied
  SweepPlan plan;
  std::vector<std::string> metrics;  // columns behind the varied keys
  Shard shard;

  /// First line of the file: index, method, the varied keys, the metrics, status.
  std::string header() const;
  /// What a row begins with: index, method, values of the varied keys; ends with a comma.
  std::string row_begin(std::int64_t sample, Join method) const;
  std::int64_t size() const { return shard.size(plan.samples()); }

  nlohmann::ordered_json to_json() const;
  /// @throws Error  cannot be read or is not of this format
  static SweepContents read(const std::string& path);
};

/// A field of a CSV file, in quotes where it has to be.
std::string csv_field(const std::string& text);

/// Where the rows of each sample are, in one file or several: 16 bytes a sample.
class SweepRows {
 public:
  /// @param samples  of the whole sweep
  explicit SweepRows(std::int64_t samples);

  /// Takes what a file holds of a sweep. A sample that is there already is left where it is, if `again` returns.
  /// @return  where the last whole sample ends; what lies behind is half-written
  /// @throws Error  cannot be read, a row that is not of this sweep (names file and line)
  std::int64_t add(const std::string& path, const SweepContents& contents,
                   const std::function<void(std::int64_t sample)>& again = {});
  /// Takes a sample that was written to the last of the files.
  void add(std::int64_t sample, std::int64_t begin, const std::string& rows);
  bool has(std::int64_t sample) const;
  std::int64_t count() const { return count_; }
  std::int64_t refused() const { return refused_; }  // those whose status is not "ok"
  /// Writes all of them in order. @throws Error  a file cannot be read any more
  void copy(std::ostream& out) const;

 private:
  struct Place {
    std::int64_t begin = -1;
    std::uint32_t length = 0;
    std::uint32_t file = 0;
  };

  std::vector<std::string> files_;
  std::vector<Place> places_;
  std::int64_t count_ = 0;
  std::int64_t refused_ = 0;
};

/// The file that a sweep fills, sample by sample. While it grows its rows are in FILE.rows, in the order in which they were
/// done; FILE appears whole, in order, so that its bytes do not depend on who did what when. Whatever ends a sweep, it is taken
/// up again by opening the file anew: what was half-written is dropped, what was done stays, also if there are more draws now.
class SweepFile {
 public:
  /// @throws Error  holds something else (names what differs), another process fills it, cannot be written
  SweepFile(const std::string& path, SweepContents contents);

  bool has(std::int64_t sample) const { return rows_.has(sample); }
  std::int64_t done() const { return rows_.count(); }
  std::int64_t refused() const { return rows_.refused(); }
  /// The rows of a sample, whole lines. @throws Error  cannot be written; what was there is as before
  void append(std::int64_t sample, const std::string& rows);
  /// To be called when all samples are there. @throws Error  cannot be written; FILE.rows stays
  void finish();

 private:
  std::string journal() const { return path_ + ".rows"; }
  void open_journal();
  void write(const std::string& text);

  std::string path_;
  SweepContents contents_;
  SweepRows rows_;
  bool whole_ = false;     // FILE has all samples
  Descriptor descriptor_;  // of the journal
  std::int64_t end_ = 0;   // of the journal
};

/// Puts the files of a sweep's shards together: the bytes are those of the sweep in one go.
/// @return  what the file now holds
/// @throws Error  they are not of one sweep, not finished, a sample is missing or twice, cannot be written
SweepContents merge_sweeps(const std::vector<std::string>& parts, const std::string& path);

}  // namespace seam
