#include "formats/ensight/case_file.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "formats/common/io/input_text.hpp"
#include "formats/common/io/named_file.hpp"
#include "formats/common/io/text_cursor.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::ensight {
namespace {

constexpr std::int64_t kMostSteps = 1'000'000;

/// A sort of variable, with the keyword at the beginning of its line.
struct VariableSort {
  std::string_view key;
  FieldLocation location;
  std::size_t components;
  std::size_t files;
};
constexpr std::array<VariableSort, 12> kSorts{
    {{"complex scalar per node", FieldLocation::node, 1, 2},
     {"complex scalar per element", FieldLocation::cell, 1, 2},
     {"complex vector per node", FieldLocation::node, 3, 2},
     {"complex vector per element", FieldLocation::cell, 3, 2},
     {"scalar per node", FieldLocation::node, 1, 1},
     {"scalar per element", FieldLocation::cell, 1, 1},
     {"vector per node", FieldLocation::node, 3, 1},
     {"vector per element", FieldLocation::cell, 3, 1},
     {"tensor symm per node", FieldLocation::node, 6, 1},
     {"tensor symm per element", FieldLocation::cell, 6, 1},
     {"tensor asym per node", FieldLocation::node, 9, 1},
     {"tensor asym per element", FieldLocation::cell, 9, 1}}};

std::vector<std::string> words_of(std::string_view text) {
  TextCursor cursor(text, "");
  std::vector<std::string> words;
  for (std::string_view word = cursor.word(); !word.empty(); word = cursor.word())
    words.emplace_back(word);
  return words;
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& path) : text_(text, path) {}

  CaseFile run() {
    while (!text_.at_end()) {
      line_ = text_.offset();
      const std::string_view line = trimmed(text_.line());
      if (line.empty() || line.starts_with('#')) continue;
      const std::size_t colon = line.find(':');
      if (colon == std::string_view::npos) {
        continue_or_begin(line);
        continue;
      }
      read_entry(trimmed(line.substr(0, colon)), trimmed(line.substr(colon + 1)));
    }
    if (case_.geometry.empty()) text_.fail("ended before its model");
    return std::move(case_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const { text_.fail_at(line_, problem); }

  /// The name of a section, or further numbers of the preceding list.
  void continue_or_begin(std::string_view line) {
    if (list_ != nullptr || numbers_ != nullptr) {
      if (to_real(words_of(line).front())) return add_numbers(line);
    }
    list_ = nullptr;
    numbers_ = nullptr;
    section_ = line;
  }

  void add_numbers(std::string_view line) {
    for (const std::string& word : words_of(line)) {
      const auto number = to_real(word);
      if (!number) fail(fmt::format("a number expected ({} found)", shown(word)));
      if (list_ != nullptr)
        list_->push_back(*number);
      else
        numbers_->push_back(static_cast<long>(*number));
    }
  }

  void read_entry(std::string_view key, std::string_view value) {
    list_ = nullptr;
    numbers_ = nullptr;
    if (section_ == "FORMAT") {
      if (key != "type") return;
      if (value != "ensight gold" && value != "ensight")
        fail(fmt::format("'ensight gold' or 'ensight' expected ({} found)", shown(value)));
      case_.version_6 = value == "ensight";
    } else if (section_ == "GEOMETRY") {
      if (key == "model") read_model(value);
    } else if (section_ == "VARIABLE") {
      read_variable(key, value);
    } else if (section_ == "TIME") {
      read_time(key, value);
    }
  }

  void read_model(std::string_view value) {
    // time set and file set numbers, the file's name, and how the geometry changes
    std::vector<std::string> words = words_of(value);
    const auto name = std::find_if(words.begin(), words.end(), [](const std::string& word) {
      return !to_integer(word).has_value();
    });
    if (name == words.end()) fail("the name of a file expected");
    case_.geometry = unquoted(*name);
    if (name != words.begin()) case_.geometry_time_set = std::atol(words[0].c_str());
  }

  void read_variable(std::string_view key, std::string_view value) {
    const auto sort = std::find_if(kSorts.begin(), kSorts.end(),
                                   [&](const VariableSort& one) { return one.key == key; });
    if (sort == kSorts.end()) {
      case_.notes.push_back(fmt::format("left out '{}: {}'", key, value));
      return;
    }
    std::vector<std::string> words = words_of(value);
    if (sort->files == 2 && words.size() > 3 && to_real(words.back())) words.pop_back();
    if (words.size() < sort->files + 1) fail("a name and its files expected");
    for (std::string& word : words) word = unquoted(word);
    Variable variable;
    variable.files.assign(words.end() - static_cast<long>(sort->files), words.end());
    variable.name = words[words.size() - sort->files - 1];
    variable.location = sort->location;
    variable.components = sort->components;
    if (words.size() > sort->files + 1) variable.time_set = std::atol(words[0].c_str());
    if (sort->files == 2 && sort->components == 3) {
      // the real and the imaginary part of a vector are two fields
      Variable imaginary = variable;
      imaginary.name += "_i";
      imaginary.files = {variable.files[1]};
      variable.name += "_r";
      variable.files.pop_back();
      case_.variables.push_back(std::move(variable));
      case_.variables.push_back(std::move(imaginary));
      return;
    }
    case_.variables.push_back(std::move(variable));
  }

  static std::string unquoted(const std::string& word) {
    return word.size() > 1 && word.front() == '"' && word.back() == '"'
               ? word.substr(1, word.size() - 2)
               : word;
  }

  /// Numbers that are stored in a separate file.
  void add_numbers_of(std::string_view name) {
    const InputText input(file_beside(text_.subject(), unquoted(std::string(name))));
    add_numbers(input.text());
    list_ = nullptr;
    numbers_ = nullptr;
  }

  void read_time(std::string_view key, std::string_view value) {
    if (key == "time set") {
      case_.time_sets.emplace_back();
      case_.time_sets.back().number = std::atol(std::string(value).c_str());
      return;
    }
    if (case_.time_sets.empty()) fail("'time set' expected");
    TimeSet& set = case_.time_sets.back();
    const std::optional<std::int64_t> number = to_integer(value);
    if (key == "number of steps") {
      if (!number || *number < 1 || *number > kMostSteps) fail("a number of steps expected");
      steps_ = *number;
    } else if (key == "filename start number") {
      start_ = number.value_or(0);
    } else if (key == "filename increment") {
      for (std::int64_t i = 0; i < steps_; ++i)
        set.file_numbers.push_back(static_cast<long>(start_ + i * number.value_or(1)));
    } else if (key == "filename numbers") {
      numbers_ = &set.file_numbers;
      if (!value.empty()) add_numbers(value);
    } else if (key == "filename numbers file") {
      numbers_ = &set.file_numbers;
      add_numbers_of(value);
    } else if (key == "time values file") {
      list_ = &set.times;
      add_numbers_of(value);
    } else if (key == "time values") {
      list_ = &set.times;
      if (!value.empty()) add_numbers(value);
    }
  }

  TextCursor text_;
  CaseFile case_;
  std::string section_;
  std::size_t line_ = 0;
  std::vector<double>* list_ = nullptr;
  std::vector<long>* numbers_ = nullptr;
  std::int64_t steps_ = 0;
  std::int64_t start_ = 0;
};

}  // namespace

const TimeSet* CaseFile::time_set(std::optional<long> number, std::string_view file) const {
  for (const TimeSet& set : time_sets)
    if (number && set.number == *number) return &set;
  const bool stars = file.find('*') != std::string_view::npos;
  return !number && stars && !time_sets.empty() ? &time_sets.front() : nullptr;
}

std::size_t TimeSet::step_at(double time) const {
  std::size_t step = 0;
  while (step + 1 < times.size() && times[step + 1] <= time) ++step;
  return step;
}

CaseFile read_case_file(const std::string& path) {
  const InputText input(path);
  return Parser(input.text(), path).run();
}

std::string file_of_step(const std::string& case_path, const std::string& name, const TimeSet* set,
                         std::size_t step) {
  std::string file = name;
  const std::size_t first = file.find('*');
  if (first != std::string::npos && set != nullptr && step < set->file_numbers.size()) {
    const std::size_t stars = file.find_last_of('*') + 1 - first;
    file.replace(first, stars, fmt::format("{:0{}}", set->file_numbers[step], stars));
  }
  return file_beside(case_path, file);
}

}  // namespace hiac::formats::ensight
