#include "tools/common/tool.hpp"

#include <algorithm>
#include <csignal>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include "hiac/base/error.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/base/seconds.hpp"
#include "hiac/base/temporary_file.hpp"
#include "tools/common/mesh_io.hpp"
#include "tools/common/plain_text.hpp"
#include "tools/common/suggestion.hpp"
#include "tools/common/text_output.hpp"
#include "tools/common/version.hpp"

namespace hiac::tools {
namespace {

// What a word of the command line that is no option may mean: " (did you mean --size?)".
std::string hint_for(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (int i = 1; i < argc; ++i) {
    const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
    if (!word.starts_with("--") || word.size() < 4 || std::ranges::find(known, word) != known.end())
      continue;
    if (const std::string meant = likely_meant(word, known); !meant.empty())
      return fmt::format(" (did you mean {}?)", meant);
  }
  return "";
}

// Whether a path is that of a regular file with something in it that no run of ours has reported.
bool is_no_report(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error) &&
         std::filesystem::file_size(path, error) > 0 && kind_of_file(path) != FileKind::facts;
}

/// The words of the command line, last one first, as CLI11 wants them. The value of --convert
/// begins with a hyphen as options do: it goes into one word with it.
std::vector<std::string> reversed_words(int argc, char** argv) {
  std::vector<std::string> words;
  for (int i = 1; i < argc; ++i) {
    words.emplace_back(argv[i]);
    if (words.back() == "--convert" && i + 1 < argc) words.back() += std::string("=") + argv[++i];
  }
  std::ranges::reverse(words);
  return words;
}

}  // namespace

std::uint64_t peak_memory_bytes() {
  std::uint64_t most = 0;
  for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    struct rusage usage {};
    getrusage(who, &usage);
    most = std::max(most, static_cast<std::uint64_t>(usage.ru_maxrss) * 1024);
  }
  return most;
}

Tool::Tool(std::string name, const std::string& description, const std::string& examples)
    : name_(std::move(name)), app_(description, name_) {
  app_.set_version_flag("--version", name_ + " " + version_text());
  app_.footer("Examples:\n" + examples +
              "\n\nExit codes: 0 done, 1 the input fails the judgement, 2 wrong usage,\n"
              "3 unreadable input or output that cannot be written, 4 anything else.");
  app_.add_flag("-q,--quiet", common_.quiet, "Print only errors");
  app_.add_flag("-v,--verbose", common_.verbose, "Print every stage of the work");
  app_.add_option("--threads", common_.threads, "Number of threads (0: all cores)")
      ->check(CLI::Range(0U, 4096U))
      ->capture_default_str();
  app_.add_option("--max-memory", common_.max_memory,
                  "End with exit code 3 when the work takes more memory than this, as 500MB or 8GB "
                  "(default: three quarters of the machine's)")
      ->transform(CLI::AsSizeValue(false))
      ->type_name("SIZE");
  app_.add_option("--json", common_.json,
                  "Write the run's facts (counts, seconds, memory) to FILE; - is stdout")
      ->type_name("FILE");
}

int Tool::run(int argc, char** argv, const std::function<void()>& work) {
  // a closed pipe and a file that is too large are errors of write(), with their messages
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    app_.parse(reversed_words(argc, argv));
  } catch (const CLI::CallForHelp&) {
    std::cout << app_.help();
    return 0;
  } catch (const CLI::CallForVersion& version) {
    std::cout << version.what() << '\n';
    return 0;
  } catch (const CLI::ParseError& error) {
    std::cerr << name_ << ": " << plain_line(error.what()) << hint_for(app_, argc, argv) << " (see "
              << name_ << " --help)\n";
    return static_cast<int>(ExitCode::usage);
  }
  start_ = seconds_now();
  auto exit_code = ExitCode::done;
  std::string message;
  try {
    const ThreadLimit limit(common_.threads);
    facts_["tool"] = name_;
    facts_["version"] = version_text();
    watch_memory();
    if (!common_.quiet) bar_ = std::make_unique<ProgressBar>(name_, frames_, progress_);
    work();
  } catch (const Cancelled&) {
    // whoever asked for it sees what an interrupt leaves behind
    bar_.reset();
    std::signal(SIGINT, SIG_DFL);
    std::raise(SIGINT);
  } catch (const Error& error) {
    exit_code = error.exit_code();
    message = error.what();
  } catch (const std::bad_alloc&) {
    exit_code = ExitCode::internal;
    message = "out of memory";
  } catch (const std::exception& error) {
    exit_code = ExitCode::internal;
    message = error.what();
  }
  bar_.reset();
  if (memory_) facts_["peak_memory_bytes"] = std::max(memory_->peak(), peak_memory_bytes());
  memory_.reset();
  if (exit_code != ExitCode::done) {
    std::cerr << name_ << ": " << plain_line(message) << '\n';
    facts_["error"] = message;
  }
  try {
    write_facts(static_cast<int>(exit_code), seconds_now() - start_);
  } catch (const Error& error) {
    std::cerr << name_ << ": " << plain_line(error.what()) << '\n';
    if (exit_code == ExitCode::done) exit_code = error.exit_code();
  }
  return static_cast<int>(exit_code);
}

void Tool::watch_memory() {
  const std::uint64_t most = common_.max_memory > 0 ? common_.max_memory : machine_memory() / 4 * 3;
  memory_ = std::make_unique<MemoryWatch>(most, [this, most] { end_at_limit(most); });
}

// In the thread that watches, while the others work on: it reads only what they do not change.
void Tool::end_at_limit(std::uint64_t most) {
  const auto code = static_cast<int>(ExitCode::input);
  std::string subject;
  nlohmann::ordered_json facts{{"tool", name_}, {"version", version_text()}};
  {
    const std::lock_guard lock(told_);
    subject = subject_;
    facts["warnings"] = warnings_;
  }
  const std::string message =
      fmt::format("{}: takes more than {:.3g} GB of memory (--max-memory SIZE sets the limit)",
                  subject, static_cast<double>(most) * 1e-9);
  std::string lines = fmt::format("{}: {}\n", name_, plain_line(message));
  facts["peak_memory_bytes"] = std::max(used_memory(), peak_memory_bytes());
  facts["error"] = message;
  facts["exit_code"] = code;
  facts["seconds"]["total"] = seconds_now() - start_;
  // before the other temporary files go: no further one begins then
  try {
    if (claimed_) write_report(facts);
  } catch (const Error& error) {
    lines += fmt::format("{}: {}\n", name_, plain_line(error.what()));
  }
  remove_temporary_files();
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, lines.data(), lines.size());
  _exit(code);
}

void Tool::claim(RunFiles files) {
  files_ = std::move(files);
  files_.outputs.insert(files_.outputs.begin(), facts_output());
  require_claims();
}

void Tool::claim_found(const std::string& mesh) {
  files_.inputs.insert(files_.inputs.begin(), mesh);
  require_claims();
}

void Tool::require_claims() {
  has_claims_ = true;
  if (!files_.inputs.empty()) {
    const std::lock_guard lock(told_);
    subject_ = input_name(files_.inputs.front());
  }
  try {
    require_safe(files_);
    claimed_ = true;
  } catch (const UsageError&) {
    facts_refused_ = true;
    throw;
  }
}

void Tool::leave_report() {
  common_.json.clear();
  common_.quiet = true;
  common_.verbose = false;
  bar_.reset();
}

void Tool::note(const std::string& line) const {
  if (!common_.quiet) print(name_ + ": " + plain_line(line) + '\n');
}

void Tool::detail(const std::string& line) const {
  if (common_.verbose) note(line);
}

void Tool::print(const std::string& text) const {
  const std::string shown = plain_text(text);
  if (bar_)
    bar_->print(shown);
  else
    std::cerr << shown;
}

void Tool::warn(const std::string& line) {
  {
    const std::lock_guard lock(told_);
    warnings_.push_back(line);
  }
  note("warning: " + line);
}

void Tool::note_frame(const std::string& path) {
  frames_.advance();
  const Progress::State state = frames_.state();
  const auto left = seconds_left(static_cast<double>(state.done), static_cast<double>(state.total),
                                 state.seconds);
  note(fmt::format("{}: {} of {} {}, about {} left", path, state.done, state.total, state.stage,
                   duration_text(left.value_or(0))));
}

void Tool::add_seconds(const std::string& stage, double seconds) {
  auto& sum = facts_["seconds"][stage];
  sum = sum.is_null() ? seconds : sum.get<double>() + seconds;
}

void Tool::end_stage(const std::string& name, double seconds) {
  add_seconds(name, seconds);
  detail(name + ": " + std::to_string(seconds) + " s");
}

Monitor Tool::monitor() {
  return {.progress = &progress_,
          .stage_ended = [this](const std::string& name, double s) { end_stage(name, s); },
          .note = [this](const std::string& line) { note(line); }};
}

void Tool::write_facts(int exit_code, double seconds) {
  if (common_.json.empty() || facts_refused_) return;
  // of a run that ends before its files are known, any file may be an input
  if (!has_claims_ && is_no_report(common_.json)) return;
  facts_["warnings"] = warnings_;
  facts_["exit_code"] = exit_code;
  facts_["seconds"]["total"] = seconds;
  write_report(facts_);
}

void Tool::write_report(const nlohmann::ordered_json& facts) const {
  if (common_.json.empty()) return;
  if (!is_stdout(common_.json)) require_same_kind(facts_output());
  // names of files need not be UTF-8
  const auto replace = nlohmann::ordered_json::error_handler_t::replace;
  write_text(common_.json, facts.dump(2, ' ', false, replace) + "\n");
}

Tool::StageClock::StageClock(Tool& tool, std::string name)
    : tool_(tool), name_(std::move(name)), start_(seconds_now()) {
  tool_.progress_.begin(name_);
}

Tool::StageClock::~StageClock() { tool_.end_stage(name_, seconds_now() - start_); }

}  // namespace hiac::tools
