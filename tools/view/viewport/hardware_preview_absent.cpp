// In place of hardware_preview.cpp in a build without the hardware preview.
#include "hiac/base/error.hpp"
#include "tools/view/viewport/hardware_preview.hpp"

namespace hiac::view {

struct HardwarePreview::State {
  std::string device;
};

HardwarePreview::HardwarePreview() {
  throw Error(ExitCode::internal, "this hiac-view was built without the hardware preview");
}
HardwarePreview::~HardwarePreview() = default;

bool HardwarePreview::draws(const Scene& /*scene*/) { return true; }

const std::string& HardwarePreview::device() const { return state_->device; }

Image HardwarePreview::draw(const std::shared_ptr<const ZooMesh>& /*mesh*/, const Scene& /*scene*/,
                            Session& /*session*/) {
  return {};
}

}  // namespace hiac::view
