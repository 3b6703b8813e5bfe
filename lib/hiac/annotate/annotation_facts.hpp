#pragma once

#include <string>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// What an annotation says of a mesh.
struct AnnotationFacts {
  std::string color_label;  ///< of the field that gives the colour; empty: none
  std::string time;         ///< as the mesh has it, a number of 6 digits at most; empty: none
};

/// A field's name with its unit, where the mesh knows it. Throws UsageError for one that does not
/// exist.
std::string field_label(const ZooMesh& mesh, const std::string& field);

AnnotationFacts annotation_facts(const ZooMesh& mesh, const Volume& volume);

}  // namespace hiac
