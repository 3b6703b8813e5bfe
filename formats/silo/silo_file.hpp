#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <silo.h>

namespace hiac::formats::silo {

/// Frees objects that the library returns.
struct Free {
  void operator()(DBmultimesh* object) const { DBFreeMultimesh(object); }
  void operator()(DBmultivar* object) const { DBFreeMultivar(object); }
  void operator()(DBucdmesh* object) const { DBFreeUcdmesh(object); }
  void operator()(DBquadmesh* object) const { DBFreeQuadmesh(object); }
  void operator()(DBucdvar* object) const { DBFreeUcdvar(object); }
  void operator()(DBquadvar* object) const { DBFreeQuadvar(object); }
};
template <typename Object>
using Owned = std::unique_ptr<Object, Free>;

/// The location of an object: its file and its name in the file, with the folders.
struct Place {
  std::string file;
  std::string name;
};

/// The files of one dataset, each opened once.
class SiloFiles {
 public:
  /// Throws InputError naming the file when it cannot be opened.
  explicit SiloFiles(const std::string& path);
  ~SiloFiles();
  SiloFiles(const SiloFiles&) = delete;
  SiloFiles& operator=(const SiloFiles&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  /// The file with that path. Throws as the constructor does.
  DBfile* open(const std::string& path);
  /// The location that a multi-block object of the first file names: "file:folder/name" or a name.
  [[nodiscard]] Place place_of(const std::string& name) const;

 private:
  std::string path_;
  std::map<std::string, DBfile*> files_;
};

/// Converts `count` numbers of one of Silo's types to double precision. Throws InputError(subject,
/// ...) when the type is not numeric.
std::vector<double> numbers(const void* data, int type, std::size_t count,
                            const std::string& subject);

}  // namespace hiac::formats::silo
