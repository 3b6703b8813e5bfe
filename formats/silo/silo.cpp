#include "formats/silo/silo.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "formats/common/io/isolated.hpp"
#include "formats/common/mesh/assemble.hpp"
#include "formats/hdf5/hdf5_model.hpp"
#include "formats/silo/blocks.hpp"
#include "formats/silo/silo_file.hpp"
#include "formats/silo/variables.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

using silo::Owned;
using silo::Place;
using silo::Variable;

class SiloReader {
 public:
  explicit SiloReader(const std::string& path)
      : subject_(path), files_(std::make_shared<silo::SiloFiles>(path)) {}

  ForeignMesh read() {
    DBfile* file = files_->open(subject_);
    const DBtoc* toc = DBGetToc(file);
    if (toc == nullptr) throw InputError(subject_, "has no table of contents");
    const std::vector<std::string> multi(toc->multimesh_names,
                                         toc->multimesh_names + toc->nmultimesh);
    const std::vector<std::string> vars(toc->multivar_names, toc->multivar_names + toc->nmultivar);
    std::vector<std::string> meshes(toc->ucdmesh_names, toc->ucdmesh_names + toc->nucdmesh);
    meshes.insert(meshes.end(), toc->qmesh_names, toc->qmesh_names + toc->nqmesh);
    std::vector<std::string> plain(toc->ucdvar_names, toc->ucdvar_names + toc->nucdvar);
    plain.insert(plain.end(), toc->qvar_names, toc->qvar_names + toc->nqvar);
    if (!multi.empty()) {
      add_multimesh(multi.front());
      for (std::size_t m = 1; m < multi.size(); ++m)
        mesh_.notes.push_back(fmt::format("left out the further multi-block mesh '{}'", multi[m]));
      for (const std::string& name : vars) note_multivar(name);
    } else {
      for (const std::string& name : meshes) add_mesh({subject_, name}, name);
      for (const std::string& name : plain) note_variable(name);
    }
    if (blocks_->empty()) throw InputError(subject_, "holds no mesh at its root");
    add_fields();
    return std::move(mesh_);
  }

 private:
  void add_multimesh(const std::string& name) {
    const Owned<DBmultimesh> multi(DBGetMultimesh(files_->open(subject_), name.c_str()));
    if (!multi) throw InputError(subject_, fmt::format("multi-block mesh '{}' is damaged", name));
    if (multi->meshnames == nullptr)
      throw InputError(subject_, fmt::format("multi-block mesh '{}' names its blocks by a name "
                                             "scheme, which is not read",
                                             name));
    for (int b = 0; b < multi->nblocks; ++b) {
      const std::string block = multi->meshnames[b] == nullptr ? "" : multi->meshnames[b];
      if (block.empty() || block == "EMPTY") continue;
      add_mesh(files_->place_of(block), block);
    }
  }

  void add_mesh(const Place& place, const std::string& name) {
    blocks_->push_back(silo::add_block(*files_, place, name, mesh_));
  }

  void note_multivar(const std::string& name) {
    if (auto variable = silo::multi_block_variable(*files_, name, blocks_->size(), mesh_.notes))
      variables_.push_back(std::move(*variable));
  }

  void note_variable(const std::string& name) {
    const std::string mesh = silo::mesh_of_variable(*files_, name);
    for (std::size_t b = 0; b < blocks_->size(); ++b)
      if (mesh == (*blocks_)[b].mesh.name || mesh == "/" + (*blocks_)[b].mesh.name)
        variables_.push_back({name, {{b, {subject_, name}}}});
  }

  void add_fields() {
    for (const Variable& variable : variables_)
      if (!variable.parts.empty())
        mesh_.fields.push_back(silo::field_of(files_, blocks_, variable, mesh_));
  }

  std::string subject_;
  std::shared_ptr<silo::SiloFiles> files_;
  ForeignMesh mesh_;
  std::shared_ptr<std::vector<silo::Block>> blocks_ = std::make_shared<std::vector<silo::Block>>();
  std::vector<Variable> variables_;
};

}  // namespace

Format silo_format() {
  Format format;
  format.name = "silo";
  format.extensions = {".silo", ".root"};
  format.kinds = "tet4 pyr5 prism6 brick8, polyhedra, structured";
  format.fields = "node, cell";
  format.time_steps = "one";
  // files of the driver PDB; files of the other driver are HDF5 files
  format.recognizes = [](std::string_view head) {
    return head.starts_with("!<<PDB:") || head.starts_with("!<><PDB>");
  };
  format.contains = [](const std::string& path) { return hdf5::model_of(path) == "silo"; };
  read_through(format, [](const std::string& path, const ReadOptions&) {
    return read_isolated(path, "Silo",
                         [](const std::string& file) { return SiloReader(file).read(); });
  });
  return format;
}

}  // namespace hiac::formats
