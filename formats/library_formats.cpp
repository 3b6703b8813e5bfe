#include "formats/library_formats.hpp"

#include "formats/ensight/ensight.hpp"
#include "formats/lsdyna/d3plot.hpp"
#include "formats/mfem/mfem.hpp"
#include "formats/openfoam/openfoam.hpp"
#include "formats/plot3d/plot3d.hpp"

#ifdef HIAC_WITH_CGNS
#  include "formats/cgns/cgns.hpp"
#endif
#ifdef HIAC_WITH_HDF5
#  include "formats/hdf5/hdf5_file.hpp"
#  include "formats/med/med.hpp"
#  include "formats/vtkhdf/vtkhdf.hpp"
#  include "formats/xdmf/xdmf.hpp"
#endif
#ifdef HIAC_WITH_SILO
#  include "formats/silo/silo.hpp"
#endif
#ifdef HIAC_WITH_NETCDF
#  include "formats/exodus/exodus.hpp"
#  include "formats/exodus/netcdf_file.hpp"
#endif

namespace hiac::formats {

void add_library_formats(std::vector<Format>& formats) {
#ifdef HIAC_WITH_HDF5
  formats.push_back(vtkhdf_format());
  formats.push_back(xdmf_format());
  formats.push_back(med_format());
#endif
#ifdef HIAC_WITH_NETCDF
  formats.push_back(exodus_format());
#endif
#ifdef HIAC_WITH_CGNS
  formats.push_back(cgns_format());
#endif
#ifdef HIAC_WITH_SILO
  formats.push_back(silo_format());
#endif
  formats.push_back(d3plot_format());
  formats.push_back(ensight_format());
  formats.push_back(plot3d_format());
  formats.push_back(mfem_format());
  formats.push_back(openfoam_format());
}

std::string further_library_versions() {
  std::string versions;
#ifdef HIAC_WITH_HDF5
  versions += ", " + hdf5::library_version();
#endif
#ifdef HIAC_WITH_NETCDF
  versions += ", " + exodus::library_version();
#endif
  return versions;
}

}  // namespace hiac::formats
