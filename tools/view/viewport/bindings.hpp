#pragma once

#include <QKeySequence>
#include <QSettings>
#include <QString>
#include <Qt>
#include <optional>
#include <vector>

namespace hiac::view {

/// What a drag in the picture does.
enum class Gesture : std::uint8_t { turn, pan, zoom, roll };

/// The table of mouse buttons and keys. The settings file has it in the groups [mouse] and [keys],
/// where it can be changed: `left = turn`, `shift+left = pan`, `reset = R`.
class Bindings {
 public:
  /// The table of the settings; what they do not name, or name wrongly, is as usual. `faults`
  /// receives a line for what is wrong.
  Bindings(QSettings& settings, QStringList& faults);

  /// What a drag with this button does; none: nothing.
  [[nodiscard]] std::optional<Gesture> gesture(Qt::MouseButton button,
                                               Qt::KeyboardModifiers modifiers) const;

  /// The key of an action; empty if it has none.
  [[nodiscard]] QKeySequence key(const QString& action) const;

  /// The lines of the table, for help: what is pressed, and what it does.
  [[nodiscard]] std::vector<std::pair<QString, QString>> lines() const;

 private:
  struct Drag {
    QString name;  // "shift+left"
    Qt::MouseButton button;
    Qt::KeyboardModifiers modifiers;
    Gesture gesture;
  };
  struct Key {
    QString action;
    QKeySequence key;
  };
  std::vector<Drag> drags_;
  std::vector<Key> keys_;
};

}  // namespace hiac::view
