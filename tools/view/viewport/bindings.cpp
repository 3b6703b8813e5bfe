#include "tools/view/viewport/bindings.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <array>

namespace hiac::view {
namespace {

struct BindingsText {
  Q_DECLARE_TR_FUNCTIONS(Bindings)
};

struct GestureName {
  const char* name;
  Gesture gesture;
  const char* text;
};
constexpr auto kGestures = std::to_array<GestureName>({
    {"turn", Gesture::turn, QT_TRANSLATE_NOOP("Bindings", "turn the camera about the centre")},
    {"pan", Gesture::pan, QT_TRANSLATE_NOOP("Bindings", "move the picture")},
    {"zoom", Gesture::zoom, QT_TRANSLATE_NOOP("Bindings", "zoom")},
    {"roll", Gesture::roll, QT_TRANSLATE_NOOP("Bindings", "roll about the line of sight")},
});

struct UsualDrag {
  const char* name;
  Qt::MouseButton button;
  Qt::KeyboardModifier modifier;
  const char* gesture;
};
constexpr auto kDrags = std::to_array<UsualDrag>({
    {"left", Qt::LeftButton, Qt::NoModifier, "turn"},
    {"middle", Qt::MiddleButton, Qt::NoModifier, "pan"},
    {"right", Qt::RightButton, Qt::NoModifier, "zoom"},
    {"shift+left", Qt::LeftButton, Qt::ShiftModifier, "pan"},
    {"ctrl+left", Qt::LeftButton, Qt::ControlModifier, "roll"},
    {"shift+middle", Qt::MiddleButton, Qt::ShiftModifier, "zoom"},
    {"ctrl+middle", Qt::MiddleButton, Qt::ControlModifier, "roll"},
    {"shift+right", Qt::RightButton, Qt::ShiftModifier, "roll"},
    {"ctrl+right", Qt::RightButton, Qt::ControlModifier, "roll"},
});

struct UsualKey {
  const char* action;
  const char* key;
};
constexpr auto kKeys = std::to_array<UsualKey>({
    {"open_mesh", "Ctrl+O"},
    {"open_view", "Ctrl+Shift+O"},
    {"save", "Ctrl+S"},
    {"save_as", "Ctrl+Shift+S"},
    {"export_picture", "S"},
    {"copy_command", "Ctrl+Shift+C"},
    {"quit", "Q"},
    {"undo", "Ctrl+Z"},
    {"redo", "Ctrl+Shift+Z"},
    {"reset", "R"},
    {"axis_views", "Shift+R"},
    {"projection", "J"},
    {"color_bar", "C"},
    {"explain_pixel", "P"},
    {"add_bump", "B"},
    {"record_keyframe", "K"},
    {"play", "Space"},
    {"help", "H"},
    {"fit_window", "F"},
    {"reload", "F5"},
});

}  // namespace

Bindings::Bindings(QSettings& settings, QStringList& faults) {
  for (const UsualDrag& usual : kDrags) {
    const QString name = QLatin1String(usual.name);
    const QString wanted =
        settings.value(QLatin1String("mouse/") + name, QLatin1String(usual.gesture)).toString();
    if (wanted.isEmpty()) continue;  // nothing is done
    const auto named = [](const QString& text) {
      return std::ranges::find_if(
          kGestures, [&](const GestureName& g) { return text == QLatin1String(g.name); });
    };
    auto found = named(wanted);
    if (found == kGestures.end()) {
      faults << BindingsText::tr("settings: mouse/%1: expected turn, pan, zoom or roll (found %2)")
                    .arg(name, wanted);
      found = named(QLatin1String(usual.gesture));
    }
    drags_.push_back({name, usual.button, usual.modifier, found->gesture});
  }
  for (const UsualKey& usual : kKeys) {
    const QString action = QLatin1String(usual.action);
    const QString wanted =
        settings.value(QLatin1String("keys/") + action, QLatin1String(usual.key)).toString();
    QKeySequence key(wanted);
    if (!wanted.isEmpty() && (key.isEmpty() || key.toString().isEmpty())) {
      faults << BindingsText::tr("settings: keys/%1: no key is called %2").arg(action, wanted);
      key = QKeySequence(QLatin1String(usual.key));
    }
    keys_.push_back({action, key});
  }
}

std::optional<Gesture> Bindings::gesture(Qt::MouseButton button,
                                         Qt::KeyboardModifiers modifiers) const {
  const Qt::KeyboardModifiers known = modifiers & (Qt::ShiftModifier | Qt::ControlModifier);
  const auto found = std::ranges::find_if(
      drags_, [&](const Drag& drag) { return drag.button == button && drag.modifiers == known; });
  return found == drags_.end() ? std::nullopt : std::optional(found->gesture);
}

QKeySequence Bindings::key(const QString& action) const {
  const auto found = std::ranges::find(keys_, action, &Key::action);
  return found == keys_.end() ? QKeySequence() : found->key;
}

std::vector<std::pair<QString, QString>> Bindings::lines() const {
  std::vector<std::pair<QString, QString>> lines;
  for (const Drag& drag : drags_) {
    const auto gesture = std::ranges::find(kGestures, drag.gesture, &GestureName::gesture);
    lines.emplace_back(drag.name, BindingsText::tr(gesture->text));
  }
  return lines;
}

}  // namespace hiac::view
