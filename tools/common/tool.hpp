#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "hiac/base/process/memory_watch.hpp"
#include "hiac/base/progress.hpp"
#include "hiac/session/session.hpp"
#include "tools/common/progress_bar.hpp"
#include "tools/common/run_files.hpp"

namespace hiac::tools {

/// What every tool has in common (the conventions of the command line).
struct CommonOptions {
  bool quiet = false;
  bool verbose = false;
  unsigned threads = 0;          ///< 0: all cores
  std::uint64_t max_memory = 0;  ///< bytes; 0: a share of the machine's
  std::string json;              ///< file for the run's facts, "-" for stdout, empty for none
};

/// The most memory that the process, or a process that worked for it and has ended, has held so
/// far.
std::uint64_t peak_memory_bytes();

/// One run of one tool: options, log lines, progress, stage timings, facts for --json, and the
/// translation of exceptions into one line on stderr and an exit code.
///
///     int main(int argc, char** argv) {
///       Tool tool("hiac-x", "What it does.", "examples ...");
///       std::string input;
///       tool.app().add_option("INPUT", input, "...");
///       return tool.run(argc, argv, [&] { ... work, throwing hiac::Error ... });
///     }
class Tool {
 public:
  /// `examples` is shown at the end of --help, one command a line.
  Tool(std::string name, const std::string& description, const std::string& examples);

  CLI::App& app() { return app_; }
  [[nodiscard]] const CommonOptions& common() const { return common_; }
  nlohmann::ordered_json& facts() { return facts_; }

  /// Parses, works, reports. Returns the process's exit code; never throws.
  int run(int argc, char** argv, const std::function<void()>& work);

  /// Tells which files the run reads and writes, before it does so: throws where an output would
  /// destroy something or cannot be written (require_safe). The file of --json is added.
  void claim(RunFiles files);
  /// Tells of a mesh that is found later, named by another input: throws where an output that is
  /// claimed would destroy it.
  void claim_found(const std::string& mesh);

  /// For a process among several, another of which reports: no file of --json, and only errors on
  /// stderr.
  void leave_report();

  /// A line on stderr unless --quiet.
  void note(const std::string& line) const;
  /// A line on stderr with --verbose.
  void detail(const std::string& line) const;
  /// A line on stderr unless --quiet, also kept among the facts' "warnings".
  void warn(const std::string& line);
  /// The warnings so far.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }
  /// Text on stderr as it is, of whole lines: what an option asks for.
  void print(const std::string& text) const;

  /// How the library tells of its work here: stages, their times, notes.
  [[nodiscard]] Monitor monitor();
  /// How far the present stage is; timed() begins one, which may begin parts of its own.
  Progress& progress() { return progress_; }
  /// How many of a run's frames or steps are done; a run of one picture leaves it alone.
  Progress& frames() { return frames_; }

  /// Advances frames() past the one that was written to `path`, and notes how many are done and how
  /// long the others will take.
  void note_frame(const std::string& path);

  /// Adds to the seconds of a stage among the facts.
  void add_seconds(const std::string& stage, double seconds);
  /// Times `stage`, adds its seconds to the facts, and returns what it returns.
  template <typename Stage>
  auto timed(const std::string& name, Stage&& stage) {
    const StageClock clock(*this, name);
    return std::forward<Stage>(stage)();
  }

 private:
  void end_stage(const std::string& name, double seconds);

  class StageClock {
   public:
    StageClock(Tool& tool, std::string name);
    ~StageClock();
    StageClock(const StageClock&) = delete;
    StageClock& operator=(const StageClock&) = delete;

   private:
    Tool& tool_;
    std::string name_;
    double start_;
  };

  void watch_memory();
  [[noreturn]] void end_at_limit(std::uint64_t most);
  void require_claims();
  void write_facts(int exit_code, double seconds);
  void write_report(const nlohmann::ordered_json& facts) const;
  [[nodiscard]] RunOutput facts_output() const { return {"--json", common_.json, FileKind::facts}; }

  std::string name_;
  CLI::App app_;
  CommonOptions common_;
  nlohmann::ordered_json facts_;
  std::mutex told_;  // guards what the memory's watch reads: warnings_ and subject_
  std::vector<std::string> warnings_;
  RunFiles files_;                     // what is claimed
  bool facts_refused_ = false;         // their file would destroy another
  bool has_claims_ = false;            // the files are known, if not tried
  std::atomic<bool> claimed_ = false;  // the outputs have been tried
  double start_ = 0;
  Progress progress_, frames_;
  std::unique_ptr<ProgressBar> bar_;  // while work is done
  std::string subject_ = "memory";    // the input, once it is claimed
  std::unique_ptr<MemoryWatch> memory_;
};

}  // namespace hiac::tools
