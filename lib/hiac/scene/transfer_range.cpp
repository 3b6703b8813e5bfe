#include "hiac/scene/transfer_range.hpp"

#include <charconv>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace hiac {
namespace {

constexpr std::string_view kPercentile = "percentile:";

/// Two numbers with a comma between; none where the text is something else.
std::optional<std::array<double, 2>> two_numbers(std::string_view text) {
  std::array<double, 2> numbers{};
  const char* const end = text.data() + text.size();
  const auto [comma, first_error] = std::from_chars(text.data(), end, numbers[0]);
  if (first_error != std::errc() || comma == end || *comma != ',') return std::nullopt;
  const auto [last, error] = std::from_chars(comma + 1, end, numbers[1]);
  if (error != std::errc() || last != end) return std::nullopt;
  return numbers;
}

std::array<double, 2> read_percents(const SpecValue& value) {
  const std::string text = value.text();
  if (text == "auto") return {0, 100};
  std::optional<std::array<double, 2>> percents;
  if (text.starts_with(kPercentile))
    percents = two_numbers(std::string_view(text).substr(kPercentile.size()));
  if (!percents)
    value.fail(
        fmt::format("no such range (expected [low, high], \"auto\" or \"percentile:1,99\", "
                    "found \"{}\")",
                    text));
  const auto [low, high] = *percents;
  if (!(low >= 0 && low < high && high <= 100))
    value.fail(fmt::format("percentiles go from 0 to 100, the lower one first (found {} and {})",
                           low, high));
  return *percents;
}

constexpr std::pair<std::string_view, TransferScale> kScales[] = {{"linear", TransferScale::linear},
                                                                  {"log", TransferScale::log}};

}  // namespace

void read_range(const SpecValue& value, TransferRange& into) {
  if (!value.is_list()) {
    into.percents = read_percents(value);
    return;
  }
  const std::vector<SpecValue> ends = value.list(2);
  const double low = ends[0].number(), high = ends[1].number();
  if (!(low < high)) value.fail(fmt::format("low must be below high (found {} and {})", low, high));
  into.fixed = {low, high};
}

void read_scale(const SpecValue& value, TransferRange& into) {
  into.scale = value.name_of<TransferScale>(kScales);
}

}  // namespace hiac
