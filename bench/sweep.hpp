#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/sweep_file.hpp"
#include "bench/sweep_plan.hpp"

namespace seam {

/// A scene of which many variants are played, each with every method.
class Sweep {
 public:
  /// @param overrides  set anew in every variant, before the varied keys
  /// @param allowed    folders of which the scene may name files, see Scene::read
  /// @throws Error  the plan is not good (SweepPlan::check), or none of up to 64 samples from all over it can be played: a key
  ///                that the scene does not know, say
  Sweep(std::string scene, std::vector<std::string> overrides, std::vector<std::string> allowed,
        SweepPlan plan, const std::string& seam_version);

  /// What the file of a shard holds. Of the files that the scene names all but meshes are told apart by their content.
  SweepContents contents(const Shard& shard) const;
  /// The rows of a sample, a line per method: what `compare` measures, 17 significant digits, nothing where a figure cannot be
  /// measured. A variant that is refused has the reason as its status, the others "ok".
  std::string play(std::int64_t sample) const;

 private:
  std::vector<std::string> overrides_of(std::int64_t sample) const;
  void probe();

  std::string scene_;
  std::vector<std::string> overrides_, allowed_;
  SweepContents contents_;
};

/// Called when samples have been played, from one thread at a time; those that were there already count as done.
using SweepProgress = std::function<void(std::int64_t done, std::int64_t total)>;

/// Plays the samples that a file does not have yet, on several threads, and finishes the file.
/// @throws Error  the file cannot be written
void run_sweep(const Sweep& sweep, const Shard& shard, int jobs, SweepFile& file,
               const SweepProgress& progress);

}  // namespace seam
