#include "formats/vtk/message_capture.hpp"

#include <algorithm>
#include <mutex>

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include "hiac/base/error.hpp"

namespace hiac::formats::vtk {
namespace {

/// VTK names an object by its class and address, "CLASS (0x55a1)", and may list its contents on
/// indented lines behind it. Takes the addresses out, and such an object with all behind it.
void cut_objects(std::string& text) {
  std::size_t at = 0;
  while ((at = text.find("(0x", at)) != std::string::npos) {
    const std::size_t close = text.find(')', at);
    if (close == std::string::npos) return;
    const bool blank_before = at > 0 && text[at - 1] == ' ';
    const std::size_t begin = blank_before ? at - 1 : at;
    if (text.compare(close, 3, ")\n ") != 0) {
      text.erase(begin, close + 1 - begin);
      continue;
    }
    const std::size_t lead = text.find_last_of(" \n", begin - 1);
    // an object alone keeps the name of its class
    const bool alone = begin == 0 || lead == std::string::npos;
    text.resize(alone ? begin : text.find_last_not_of(" :\n", lead) + 1);
    return;
  }
}

/// The sentence in VTK's message, which is "ERROR: In FILE, line N\nCLASS (ADDRESS): sentence\n\n".
std::string sentence_of(std::string text) {
  if (const std::size_t address = text.find("): "); address != std::string::npos)
    text.erase(0, address + 3);
  else if (text.starts_with("ERROR: In ") || text.starts_with("Warning: In ") ||
           text.starts_with("Generic Warning: In "))
    text.erase(0, text.find('\n') + 1);
  cut_objects(text);
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

class CapturingWindow : public vtkOutputWindow {
 public:
  static CapturingWindow* New();
  vtkTypeMacro(CapturingWindow, vtkOutputWindow);

  void DisplayText(const char*) override {}
  void DisplayErrorText(const char* text) override { keep_error(text); }
  void DisplayGenericWarningText(const char* text) override { keep_error(text); }
  void DisplayWarningText(const char* text) override {
    const std::lock_guard lock(mutex_);
    const std::string warning = sentence_of(text);
    if (warnings_.size() < kMostWarnings &&
        std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end())
      warnings_.push_back(warning);
  }
  void DisplayDebugText(const char*) override {}

  [[nodiscard]] std::string first_error() const {
    const std::lock_guard lock(mutex_);
    return first_error_;
  }
  [[nodiscard]] std::vector<std::string> warnings() const {
    const std::lock_guard lock(mutex_);
    return warnings_;
  }

 protected:
  CapturingWindow() = default;

 private:
  static constexpr std::size_t kMostWarnings = 8;

  /// The first message states the error; after an error, a reader can print one for every number.
  void keep_error(const char* text) {
    const std::lock_guard lock(mutex_);
    if (first_error_.empty()) first_error_ = sentence_of(text);
  }

  mutable std::mutex mutex_;
  std::string first_error_;
  std::vector<std::string> warnings_;
};
vtkStandardNewMacro(CapturingWindow);

}  // namespace

struct MessageCapture::State {
  vtkNew<CapturingWindow> window;
  vtkSmartPointer<vtkOutputWindow> outer;
  vtkLogger::Verbosity outer_verbosity;
};

MessageCapture::MessageCapture() : state_(std::make_unique<State>()) {
  state_->outer = vtkOutputWindow::GetInstance();
  state_->outer_verbosity = vtkLogger::GetCurrentVerbosityCutoff();
  vtkOutputWindow::SetInstance(state_->window);
  // VTK sends each message to its logger too, which prints it
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

MessageCapture::~MessageCapture() {
  vtkOutputWindow::SetInstance(state_->outer);
  vtkLogger::SetStderrVerbosity(state_->outer_verbosity);
}

void MessageCapture::throw_on_error(const std::string& subject) const {
  const std::string message = state_->window->first_error();
  if (!message.empty()) throw InputError(subject, "cannot be read: " + message);
}

bool MessageCapture::any_error() const { return !state_->window->first_error().empty(); }

std::vector<std::string> MessageCapture::warnings() const { return state_->window->warnings(); }

}  // namespace hiac::formats::vtk
