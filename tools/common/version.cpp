#include "tools/common/version.hpp"

#include <CLI/Version.hpp>
#include <OpenEXR/OpenEXRConfig.h>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <oneapi/tbb/version.h>
#include <png.h>
#include <tiffvers.h>
#include <toml++/toml.h>
#include <xxhash.h>

#include "hiac/base/version.hpp"

namespace hiac::tools {

std::string version_text() {
  return fmt::format(
      "{} (oneTBB {}.{}, Highway {}, {{fmt}} {}, OpenEXR {}, libpng {}, libtiff {}.{}.{}, toml++ "
      "{}.{}.{}, "
      "nlohmann/json {}.{}.{}, CLI11 {}, xxHash {}.{}.{})",
      HIAC_VERSION, TBB_VERSION_MAJOR, TBB_VERSION_MINOR, HIAC_HWY_VERSION, FMT_VERSION,
      OPENEXR_VERSION_STRING, PNG_LIBPNG_VER_STRING, TIFFLIB_MAJOR_VERSION, TIFFLIB_MINOR_VERSION,
      TIFFLIB_MICRO_VERSION, TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH,
      NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH,
      CLI11_VERSION, XXH_VERSION_MAJOR, XXH_VERSION_MINOR, XXH_VERSION_RELEASE);
}

}  // namespace hiac::tools
