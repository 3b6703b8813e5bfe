#include "hiac/base/version.hpp"

namespace hiac {

std::string_view library_version() noexcept { return HIAC_VERSION; }

}  // namespace hiac
