#pragma once

#include <QObject>
#include <QString>
#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "hiac/session/histogram/volume_histogram.hpp"

namespace hiac::view {

/// Measures histograms on a thread of its own: the last one that was asked for.
class HistogramSource : public QObject {
  Q_OBJECT

 public:
  static constexpr std::size_t kBins = 512;

  explicit HistogramSource(QObject* parent = nullptr) : QObject(parent) {}
  ~HistogramSource() override;

  /// Measures a field over these values, low < high, both positive on a logarithmic scale;
  /// `measured` tells the result.
  void measure(std::shared_ptr<const ZooMesh> mesh, const std::string& field,
               const std::array<double, 2>& values, TransferScale scale);
  /// Whether nothing is under way.
  [[nodiscard]] bool is_at_rest() const { return !thread_.joinable(); }

 Q_SIGNALS:
  void measured(std::shared_ptr<const hiac::VolumeHistogram> histogram, QString field);

 private:
  struct Wanted {
    std::shared_ptr<const ZooMesh> mesh;
    std::string field;
    std::array<double, 2> values;
    TransferScale scale;
  };
  void start(Wanted wanted);
  void finish(std::shared_ptr<const VolumeHistogram> histogram, const QString& field);

  std::optional<Wanted> next_;  // once the present one is done
  std::thread thread_;
};

}  // namespace hiac::view
