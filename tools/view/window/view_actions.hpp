#pragma once

#include <QObject>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "tools/view/document/document.hpp"
#include "tools/view/viewport/painter.hpp"

namespace hiac::view {

/// What the window does with the camera and the picture: edits of the document, of the frame of its
/// camera path that is shown.
class ViewActions : public QObject {
  Q_OBJECT

 public:
  /// The document must outlive this object.
  explicit ViewActions(Document& document);

  /// The frame that is shown; below the path's number of frames.
  [[nodiscard]] std::uint32_t frame() const { return frame_; }
  void set_frame(std::uint32_t frame);

  /// Rays along a side of each pixel at rest.
  void set_samples(std::uint32_t samples);
  [[nodiscard]] std::uint32_t samples() const { return samples_; }

  /// Whether graphics hardware draws while something moves.
  void set_hardware(bool on);
  [[nodiscard]] bool hardware() const { return hardware_; }

  /// What is to be drawn; none without a mesh or a text.
  [[nodiscard]] std::optional<Wanted> wanted() const;
  /// The camera of the frame; none without a text.
  [[nodiscard]] std::optional<Camera> camera() const;
  /// The depths between which the mesh lies, as the camera sees it: those of a sphere around it.
  [[nodiscard]] std::array<double, 2> depths() const;

  /// All of the mesh, in the same direction.
  void reset();
  /// The next of the six views along the axes.
  void next_axis_view();
  /// Looks along an axis (0 to 2), forwards or backwards.
  void look_along(std::size_t axis, bool backwards);
  void toggle_projection();
  void toggle_color_bar();
  void set_size(ImageSize size);
  void set_clip(const std::optional<std::array<double, 2>>& clip, bool goes_on);
  void move_camera(const Camera& camera, const QString& label, bool goes_on);
  void record_keyframe(std::uint32_t frame);

 Q_SIGNALS:
  void changed();              ///< frame, samples or hardware
  void message(QString line);  ///< why an edit is not possible

 private:
  struct Ball {
    std::array<double, 3> middle{};
    double radius = 1;
  };
  void follow_document();
  void measure_mesh();
  void edit(const QString& label, bool goes_on, const std::function<std::string()>& text);

  Document& document_;
  std::uint32_t frame_ = 0, samples_ = 1;
  bool hardware_ = false;
  std::size_t axis_view_ = 0;
  Ball ball_;  // around the cells of the mesh
};

}  // namespace hiac::view
