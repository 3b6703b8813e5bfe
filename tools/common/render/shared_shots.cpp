#include "tools/common/render/shared_shots.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

namespace hiac::tools {
namespace {

using Json = nlohmann::ordered_json;

Bytes message_of(const std::vector<ShotReport>& reports) {
  Json told = Json::array();
  for (const ShotReport& report : reports)
    told.push_back({{"shot", report.shot}, {"facts", report.facts}, {"warnings", report.warnings}});
  // binary: numbers keep their bits, and text need not be valid
  const std::vector<std::uint8_t> bytes = Json::to_cbor(told);
  const auto view = std::as_bytes(std::span(bytes));
  return {view.begin(), view.end()};
}

void add_reports(const Bytes& message, bool are_own, std::vector<ShotReport>& reports) {
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(message.data());
  for (const Json& told : Json::from_cbor(bytes, bytes + message.size()))
    reports.push_back({told["shot"].get<std::size_t>(), told["facts"],
                       told["warnings"].get<std::vector<std::string>>(), are_own});
}

}  // namespace

std::size_t shared_shots(const Communicator* all, std::size_t count) {
  return all == nullptr ? count : count % all->size();
}

std::vector<ShotReport> share_shots(Communicator& all, std::size_t count,
                                    const std::function<ShotReport(std::size_t shot)>& draw) {
  std::vector<ShotReport> own;
  all.restart_numbers();
  for (std::uint64_t shot = all.take_number(); shot < count; shot = all.take_number())
    own.push_back(draw(shot));
  const std::vector<Bytes> told = gather(all, message_of(own));
  if (all.rank() != 0) return {};
  std::vector<ShotReport> reports;
  for (std::size_t rank = 0; rank < told.size(); ++rank)
    add_reports(told[rank], rank == 0, reports);
  std::ranges::sort(reports, {}, &ShotReport::shot);
  return reports;
}

}  // namespace hiac::tools
