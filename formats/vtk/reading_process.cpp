#include "formats/vtk/reading_process.hpp"

#include <charconv>
#include <cstdlib>
#include <set>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <vtkDataSet.h>

#include "formats/common/io/bytes_behind.hpp"
#include "formats/vtk/legacy/legacy_file.hpp"
#include "formats/vtk/packed_dataset.hpp"
#include "formats/vtk/xml/xml_file.hpp"
#include "hiac/base/error.hpp"
#include "hiac/base/process/isolated_process.hpp"
#include "hiac/base/process/pack.hpp"

namespace hiac::formats::vtk {
namespace {

constexpr std::string_view kOpen = "open";
constexpr std::string_view kWhole = "whole";
constexpr std::string_view kPiece = "piece ";
constexpr std::string_view kLegacy = "legacy";

void pack_texts(PackWriter& out, const std::vector<std::string>& texts) {
  out.number(texts.size());
  for (const std::string& text : texts) out.text(text);
}

void pack_field_steps(PackWriter& out, const FieldSteps& fields) {
  out.number(fields.size());
  for (const auto& [name, steps] : fields) {
    out.text(name);
    out.array(std::span<const std::size_t>(std::vector<std::size_t>(steps.begin(), steps.end())));
  }
}

FieldSteps unpack_field_steps(PackReader& in, std::size_t step_count) {
  FieldSteps fields;
  for (std::uint64_t count = in.count(); count > 0; --count) {
    std::set<std::size_t>& steps = fields[in.text()];
    for (const std::size_t step : in.array<std::size_t>()) {
      if (step >= step_count) in.fail();
      steps.insert(step);
    }
  }
  return fields;
}

// ---- in the process that reads

template <typename T>
T number_in(std::string_view text) {
  T value{};
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// The words between the bars of an open request.
std::vector<std::string_view> words_of(std::string_view request) {
  std::vector<std::string_view> words;
  for (std::size_t bar = request.find('|'); bar != std::string_view::npos;) {
    request.remove_prefix(bar + 1);
    bar = request.find('|');
    words.push_back(request.substr(0, bar));
  }
  return words;
}

/// Reads files, one after the other.
class Service {
 public:
  void answer(const std::string& path, std::string_view request, PackWriter& out) {
    // threads do not survive a fork
    setenv("VTK_SMP_BACKEND_IN_USE", "Sequential", 1);
    if (request == kLegacy) return read_legacy(path, out);
    if (request.starts_with(kOpen)) return open(path, words_of(request), out);
    if (request.starts_with(kPiece))
      pack_dataset(out, *xml_->read_piece(number_in<std::size_t>(request.substr(kPiece.size()))));
    else
      pack_dataset(out, *xml_->read_whole());
    pack_texts(out, xml_->warnings());
  }

 private:
  void open(const std::string& path, const std::vector<std::string_view>& words, PackWriter& out) {
    ReadOptions options;
    if (!words.at(1).empty()) options.step = number_in<std::size_t>(words[1]);
    if (!words.at(2).empty()) options.time = number_in<double>(words[2]);
    options.nearest_time = !words.at(3).empty();
    xml_.reset();  // VTK's messages go to one file at a time
    xml_ = std::make_unique<XmlFile>(path, std::string(words[0]), options);
    const auto& step = xml_->step();
    out.number(xml_->piece_count());
    out.array(std::span<const double>(step ? step->times : std::vector<double>()));
    out.number(step ? step->step : 0);
    pack_field_steps(out, step ? step->field_steps : FieldSteps());
    std::vector<std::string> notes = xml_->notes();
    note_behind_root(xml_->file_text(), "VTKFile", notes);
    pack_texts(out, notes);
  }

  void read_legacy(const std::string& path, PackWriter& out) {
    xml_.reset();
    const LegacyDataset legacy = read_legacy_file(path);
    pack_dataset(out, *legacy.dataset);
    out.text(legacy.title);
    pack_texts(out, legacy.notes);
  }

  std::unique_ptr<XmlFile> xml_;
};

}  // namespace

std::shared_ptr<IsolatedProcess> reading_process() {
  thread_local std::weak_ptr<IsolatedProcess> current;
  std::shared_ptr<IsolatedProcess> process = current.lock();
  if (process != nullptr) return process;
  process = std::make_shared<IsolatedProcess>(
      "VTK", [service = std::make_shared<Service>()](const std::string& path,
                                                     const std::string& request, PackWriter& out) {
        service->answer(path, request, out);
      });
  current = process;
  return process;
}

std::string open_request(const XmlRequest& request) {
  return fmt::format(
      "{}|{}|{}|{}|{}", kOpen, request.type, request.step ? fmt::format("{}", *request.step) : "",
      request.time ? fmt::format("{}", *request.time) : "", request.nearest_time ? "nearest" : "");
}

std::string whole_request() { return std::string(kWhole); }

std::string piece_request(std::size_t index) { return fmt::format("{}{}", kPiece, index); }

std::string legacy_request() { return std::string(kLegacy); }

OpenedXml unpack_opened(PackReader& in) {
  OpenedXml opened;
  opened.pieces = in.number();
  opened.times = in.array<double>();
  opened.step = in.number();
  if (opened.step > 0 && opened.step >= opened.times.size()) in.fail();
  opened.field_steps = unpack_field_steps(in, opened.times.size());
  opened.notes = unpack_texts(in);
  return opened;
}

std::vector<std::string> unpack_texts(PackReader& in) {
  std::vector<std::string> texts(in.count());
  for (std::string& text : texts) text = in.text();
  return texts;
}

}  // namespace hiac::formats::vtk
