#pragma once

#include <span>

#include "hiac/scene/annotation.hpp"
#include "hiac/scene/toml/spec_key.hpp"

namespace hiac {

/// The keys of [annotation] and of its tables.
std::span<const SpecKey<Annotation>> annotation_keys();
std::span<const SpecKey<TitleAnnotation>> title_keys();
std::span<const SpecKey<TimeAnnotation>> time_keys();
std::span<const SpecKey<AxesAnnotation>> axes_keys();
std::span<const SpecKey<LengthAnnotation>> length_keys();
std::span<const SpecKey<ColorBarAnnotation>> color_bar_keys();

/// Reads [annotation] and its tables; a table with `show = false` is as if it were absent.
Annotation read_annotation(const SpecValue& table);

/// Throws if the annotation shows what the scene does not have.
void check_annotation(const SpecValue& document, const Scene& scene, const Annotation& annotation);

}  // namespace hiac
