// Random damage of every kind of input of every tool: the tool ends by itself, soon, within its
// memory, with exit code 0, 1, 2 or 3 and a message. HIAC_MUTATIONS: how many changes of each input
// are tried (3).

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "formats/registry.hpp"
#include "tests/fuzz/input_files.hpp"
#include "tests/fuzz/seeds.hpp"
#include "tests/support/mutated_bytes.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/tools/small_inputs.hpp"

namespace hiac::test {
namespace {

namespace fs = std::filesystem;

constexpr double kMostSeconds = 20;
constexpr double kMostBytes = 1.1e9;  // --max-memory 1GB, which is looked at fifty times a second

/// What the processes that have ended took of the processors, seconds.
double seconds_of_children() {
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// The most that one of them has held.
double memory_of_children() {
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  return 1024.0 * static_cast<double>(used.ru_maxrss);
}

/// A damaged file's name: "d" in place of the sound one's "a" in "a.png", "m" in "m.zoo".
std::string damaged_name(const std::string& sound) { return "d" + sound.substr(sound.find('.')); }

std::string with_name(std::string command, const std::string& name) {
  const std::size_t at = command.find("%s");
  return at == std::string::npos ? command : command.replace(at, 2, name);
}

std::string last_line(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

// Whether a message of ours ends a complaint; where MPI aborts, its own notices follow.
bool tells_why(const std::string& command, const std::string& complaint) {
  if (command.find("hiac-render-mpi") != std::string::npos)
    return complaint.starts_with("hiac") || complaint.find("\nhiac") != std::string::npos;
  return last_line(complaint).starts_with("hiac");
}

/// Runs commands in a folder, and judges how they end.
class Judge {
 public:
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.file(name); }
  [[nodiscard]] const fs::path& folder() const { return folder_.path(); }
  [[nodiscard]] std::string complaint() const { return bytes_of(path("err.txt")); }
  [[nodiscard]] int runs() const { return runs_; }
  /// Of the last command.
  [[nodiscard]] int code() const { return code_; }

  /// The exit status; 128 and the signal's number where one ended it, as after 20 seconds of work;
  /// 124 where nothing happens.
  [[nodiscard]] int run(const std::string& command) {
    ++runs_;
    const int status =
        std::system(("cd '" + folder().string() + "' && ulimit -t 20 && timeout 300 sh -c \"" +
                     command + " --max-memory 1GB\" >out.txt 2>err.txt </dev/null")
                        .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  /// Runs a command on a damaged input, which is kept where the end is a wrong one.
  [[nodiscard]] testing::AssertionResult ends_well(const std::string& command,
                                                   const std::string& kept_as,
                                                   const std::string& bytes) {
    const double before = seconds_of_children();
    code_ = run(command);
    const double seconds = seconds_of_children() - before;
    std::string wrong;
    if (code_ < 0 || code_ > 3) wrong = "exit code " + std::to_string(code_);
    if (code_ > 0 && code_ <= 3 && !tells_why(command, complaint())) wrong = "no message";
    if (seconds > kMostSeconds) wrong += " " + std::to_string(seconds) + " s";
    if (memory_of_children() > kMostBytes) wrong += " " + std::to_string(memory_of_children());
    if (wrong.empty()) return testing::AssertionSuccess();
    const std::string kept = "/tmp/hiac-mutated-finding-" + kept_as;
    std::ofstream(kept, std::ios::binary) << bytes;
    return testing::AssertionFailure()
           << command << ": " << wrong << " (input kept in " << kept << ")\n"
           << complaint();
  }

 private:
  ScratchFolder folder_;
  int runs_ = 0, code_ = 0;
};

class MutatedInputs : public testing::TestWithParam<ToolInputs> {};

TEST_P(MutatedInputs, EndWithACodeAndALine) {
  Judge judge;
  ASSERT_EQ(write_small_inputs(judge.folder()), "");
  std::mt19937 random(20261123);
#ifdef HIAC_PREVIEW
  if (GetParam().tool == "preview" && judge.run(HIAC_PREVIEW " --list-devices") != 0)
    GTEST_SKIP() << "no driver can draw";
#endif
  for (const SmallInput& input : GetParam().inputs) {
    const std::string sound = bytes_of(judge.path(input.name));
    ASSERT_FALSE(sound.empty()) << input.name;
    const std::string damaged = damaged_name(input.name);
    const std::string command = with_name(input.command, damaged);
    for (int round = 0; round <= mutations_wanted(3); ++round) {
      const std::string bytes = round == 0 ? sound : mutated(sound, random);
      std::ofstream(judge.path(damaged), std::ios::binary) << bytes;
      ASSERT_TRUE(judge.ends_well(command, damaged, bytes));
      if (round == 0) {
        ASSERT_EQ(judge.code(), 0) << command << "\n" << judge.complaint();
      }
    }
    // what a command has put the damaged file in place of
    std::ofstream(judge.path(input.name), std::ios::binary) << sound;
  }
  RecordProperty("runs", judge.runs());
}

std::string name_of(const testing::TestParamInfo<ToolInputs>& info) {
  std::string name = info.param.tool;
  std::erase(name, '-');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Of, MutatedInputs, testing::ValuesIn(inputs_of_tools()), name_of);

/// Small sound inputs of a format: those that the readers are fuzzed with, and small files of the
/// folder of data, for formats that libraries write.
std::vector<std::string> sound_inputs(const formats::Format& format) {
  std::vector<std::string> inputs = fuzz::seeds(std::string(format.name));
  constexpr std::uintmax_t kSmall = 100000;
  const char* const data = std::getenv("HIAC_DATA_DIR");
  const fs::path folder = fs::path(data == nullptr ? "" : data) / std::string(format.name);
  std::error_code error;
  if (!inputs.empty() || data == nullptr || !fs::is_directory(folder, error)) return inputs;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.file_size() < kSmall &&
        std::ranges::find(format.extensions, entry.path().extension().string()) !=
            format.extensions.end())
      inputs.push_back(bytes_of(entry.path().string()));
  return inputs;
}

class MutatedFormats : public testing::TestWithParam<std::string> {};

TEST_P(MutatedFormats, EndWithACodeAndALine) {
  const formats::Format& format = formats::format_named(GetParam());
  const std::vector<std::string> sound = sound_inputs(format);
  if (sound.empty()) GTEST_SKIP() << "no small file is there (HIAC_DATA_DIR)";
  Judge judge;
  const fuzz::InputFolder folder;
  std::mt19937 random(20261123);
  const std::string main_name = "input" + std::string(format.extensions.front());
  const std::string read = HIAC_CONVERT " --format " + GetParam() + " ";
  for (int round = 0; round <= mutations_wanted(3); ++round) {
    const std::string& from = sound[static_cast<std::size_t>(round) % sound.size()];
    const std::string bytes = round == 0 ? from : mutated(from, random);
    const fuzz::InputFolder::Files files = folder.write(bytes, main_name);
    const std::string options = round % 8 == 7 ? "--list " : "--approximate -o o.zoo ";
    ASSERT_TRUE(judge.ends_well(read + options + files.main(), main_name, bytes));
    if (round == 0) {
      ASSERT_EQ(judge.code(), 0) << judge.complaint();
    }
  }
  RecordProperty("runs", judge.runs());
}

/// All but meshes in parts, which are several zoo containers: those are inputs of the tools above.
std::vector<std::string> readable_formats() {
  std::vector<std::string> names;
  for (const formats::Format& format : formats::all_formats())
    if (format.read && format.name != "zparts") names.emplace_back(format.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Of, MutatedFormats, testing::ValuesIn(readable_formats()),
                         [](const testing::TestParamInfo<std::string>& kind) {
                           std::string name = kind.param;
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace hiac::test
