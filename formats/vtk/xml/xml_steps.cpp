#include "formats/vtk/xml/xml_steps.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "formats/common/io/printable.hpp"
#include "formats/common/mesh/steps.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::vtk {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

/// text[begin, end).
struct Span {
  std::size_t begin = 0;
  std::size_t end = 0;
};

struct Attribute {
  Span whole;  ///< name, sign and quoted value
  std::string_view value;
};

/// A tag from its '<' to just after its '>'.
struct Tag {
  Span whole;
  std::string_view name;  ///< with the '/' of a closing tag
  bool empty = false;     ///< ends with "/>"
};

class Steps {
 public:
  Steps(std::string_view text, const std::string& type, const std::string& subject)
      : text_(text), type_(type), subject_(subject) {}

  std::optional<XmlStep> at(const ReadOptions& options) {
    const std::optional<Tag> primary = find_primary();
    if (!primary) return std::nullopt;
    const auto values = attribute(*primary, "TimeValues");
    XmlStep result;
    result.times =
        values ? numbers<double>(values->value, "TimeValues") : counted_steps(primary->whole.end);
    if (!values && result.times.size() < 2) return std::nullopt;
    if (result.times.empty()) fail("TimeValues tells no time");
    for (const double time : result.times)
      if (!std::isfinite(time)) fail(fmt::format("TimeValues: a time is not finite ({})", time));
    const auto step = requested_step(options, result.times, subject_);
    result.step = step.value_or(result.times.size() - 1);
    if (values) blanked_.push_back(values->whole);
    sort_arrays(primary->whole.end, result);
    result.text = text_;
    for (const Span& span : blanked_)
      std::fill(result.text.begin() + static_cast<std::ptrdiff_t>(span.begin),
                result.text.begin() + static_cast<std::ptrdiff_t>(span.end), ' ');
    return result;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(subject_, printable(what));
  }

  /// The next tag from `at` on; skips comments and declarations.
  [[nodiscard]] std::optional<Tag> next_tag(std::size_t at) const {
    while (true) {
      const std::size_t begin = text_.find('<', at);
      if (begin == std::string_view::npos) return std::nullopt;
      if (text_.substr(begin).starts_with("<!--")) {
        at = text_.find("-->", begin);
        if (at == std::string_view::npos) return std::nullopt;
        continue;
      }
      const std::size_t end = tag_end(begin);
      if (end == std::string_view::npos) return std::nullopt;
      const char mark = text_[begin + 1];
      if (mark != '?' && mark != '!') {
        const std::size_t name_end =
            std::min(text_.find_first_of(" \t\r\n/>", begin + 2), text_.size());
        return Tag{
            {begin, end}, text_.substr(begin + 1, name_end - begin - 1), text_[end - 2] == '/'};
      }
      at = end;
    }
  }

  /// The position after the '>' of the tag that begins there; attribute values may contain '>'.
  [[nodiscard]] std::size_t tag_end(std::size_t begin) const {
    std::size_t at = begin + 1;
    while (true) {
      at = text_.find_first_of("\"'>", at);
      if (at == std::string_view::npos) return at;
      if (text_[at] == '>') return at + 1;
      at = text_.find(text_[at], at + 1);
      if (at == std::string_view::npos) return at;
      ++at;
    }
  }

  [[nodiscard]] std::optional<Attribute> attribute(const Tag& tag, std::string_view name) const {
    std::size_t at = tag.whole.begin + 1 + tag.name.size();
    while (true) {
      const std::size_t begin = text_.find_first_not_of(kBlanks, at);
      const std::size_t sign = text_.find('=', at);
      if (sign >= tag.whole.end) return std::nullopt;
      const std::size_t open = text_.find_first_of("\"'", sign);
      if (open >= tag.whole.end) return std::nullopt;
      const std::size_t close = text_.find(text_[open], open + 1);
      if (close >= tag.whole.end) return std::nullopt;
      std::string_view found = text_.substr(begin, sign - begin);
      found = found.substr(0, found.find_first_of(kBlanks));
      if (found == name)
        return Attribute{{begin, close + 1}, text_.substr(open + 1, close - open - 1)};
      at = close + 1;
    }
  }

  template <typename Number>
  [[nodiscard]] std::vector<Number> numbers(std::string_view words, const char* what) const {
    std::vector<Number> values;
    const char* at = words.data();
    const char* const end = at + words.size();
    while (true) {
      while (at != end && kBlanks.find(*at) != std::string_view::npos) ++at;
      if (at == end) return values;
      Number value{};
      const auto [next, error] = std::from_chars(at, end, value);
      if (error != std::errc() || (next != end && kBlanks.find(*next) == std::string_view::npos))
        fail(fmt::format("{}: numbers expected, '{}' found", what,
                         std::string_view(at, static_cast<std::size_t>(end - at)).substr(0, 40)));
      values.push_back(value);
      at = next;
    }
  }

  [[nodiscard]] std::optional<Tag> find_primary() const {
    for (auto tag = next_tag(0); tag; tag = next_tag(tag->whole.end)) {
      if (tag->name == type_) return tag;
      if (tag->name != "VTKFile") return std::nullopt;
    }
    return std::nullopt;
  }

  /// The position after the element that the tag begins.
  [[nodiscard]] std::size_t element_end(const Tag& tag) const {
    if (tag.empty) return tag.whole.end;
    for (auto next = next_tag(tag.whole.end); next; next = next_tag(next->whole.end))
      if (next->name.starts_with('/') && next->name.substr(1) == tag.name) return next->whole.end;
    fail(fmt::format("is not well-formed: a {} is not closed", tag.name));
  }

  /// The times of a file that does not state them: the numbers of its steps, if these go from 0 on
  /// without a gap.
  [[nodiscard]] std::vector<double> counted_steps(std::size_t at) const {
    std::set<std::size_t> steps;
    for (auto tag = next_tag(at); tag && tag->name != "AppendedData"; tag = next_tag(at)) {
      at = tag->whole.end;
      if (tag->name != "DataArray" && tag->name != "Array") continue;
      if (const auto mark = attribute(*tag, "TimeStep"))
        for (const std::size_t step : numbers<std::size_t>(mark->value, "TimeStep"))
          steps.insert(step);
    }
    if (steps.empty() || *steps.rbegin() != steps.size() - 1) return {};
    return {steps.begin(), steps.end()};
  }

  /// Records what must be blanked so that only the arrays of the chosen step remain.
  void sort_arrays(std::size_t at, XmlStep& chosen) {
    std::vector<bool> told(chosen.times.size(), false);
    bool any = false;
    for (auto tag = next_tag(at); tag && tag->name != "AppendedData"; tag = next_tag(at)) {
      at = tag->whole.end;
      if (tag->name != "DataArray" && tag->name != "Array") continue;
      const auto mark = attribute(*tag, "TimeStep");
      if (!mark) continue;
      any = true;
      bool wanted = false;
      for (const std::size_t step : numbers<std::size_t>(mark->value, "TimeStep")) {
        if (step >= told.size())
          fail(
              fmt::format("an array belongs to step {} (0 to {} expected)", step, told.size() - 1));
        told[step] = true;
        if (const auto name = attribute(*tag, "Name"))
          chosen.field_steps[std::string(name->value)].insert(step);
        wanted |= step == chosen.step;
      }
      if (!wanted) at = element_end(*tag);
      blanked_.push_back(wanted ? mark->whole : Span{tag->whole.begin, at});
    }
    const auto missing = std::find(told.begin(), told.end(), false);
    if (any && missing != told.end())
      fail(fmt::format("tells {} time steps, but no array belongs to step {}", told.size(),
                       missing - told.begin()));
  }

  std::string_view text_;
  const std::string& type_;
  const std::string& subject_;
  std::vector<Span> blanked_;
};

}  // namespace

std::optional<XmlStep> xml_step(std::string_view text, const std::string& type,
                                const ReadOptions& options, const std::string& subject) {
  return Steps(text, type, subject).at(options);
}

}  // namespace hiac::formats::vtk
