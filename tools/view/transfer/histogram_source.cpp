#include "tools/view/transfer/histogram_source.hpp"

#include <utility>

#include "hiac/base/error.hpp"

namespace hiac::view {
namespace {

/// Null if the mesh has no such field any more.
std::shared_ptr<const VolumeHistogram> histogram_of(const ZooMesh& mesh, const std::string& field,
                                                    const std::array<double, 2>& values,
                                                    TransferScale scale) {
  try {
    const std::vector<double> edges =
        bin_edges(values[0], values[1], HistogramSource::kBins, scale);
    return std::make_shared<const VolumeHistogram>(
        volume_histogram(mesh, scalar_field(mesh, field), edges));
  } catch (const Error&) {
    return nullptr;  // the document tells what is wrong with its fields
  }
}

}  // namespace

HistogramSource::~HistogramSource() {
  if (thread_.joinable()) thread_.join();
}

void HistogramSource::measure(std::shared_ptr<const ZooMesh> mesh, const std::string& field,
                              const std::array<double, 2>& values, TransferScale scale) {
  Wanted wanted{std::move(mesh), field, values, scale};
  if (thread_.joinable())
    next_ = std::move(wanted);
  else
    start(std::move(wanted));
}

void HistogramSource::start(Wanted wanted) {
  thread_ = std::thread([this, wanted = std::move(wanted)] {
    auto histogram = histogram_of(*wanted.mesh, wanted.field, wanted.values, wanted.scale);
    QMetaObject::invokeMethod(
        this,
        [this, histogram = std::move(histogram), field = QString::fromStdString(wanted.field)] {
          finish(histogram, field);
        },
        Qt::QueuedConnection);
  });
}

void HistogramSource::finish(std::shared_ptr<const VolumeHistogram> histogram,
                             const QString& field) {
  thread_.join();
  if (next_)
    start(*std::exchange(next_, std::nullopt));
  else if (histogram)
    Q_EMIT measured(std::move(histogram), field);
}

}  // namespace hiac::view
