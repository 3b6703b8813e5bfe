#include "tools/view/transfer/transfer_panel.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QSplitter>
#include <QVBoxLayout>
#include <cmath>
#include <utility>

#include "hiac/base/error.hpp"
#include "hiac/scene/colormaps/built_in_colormaps.hpp"
#include "hiac/scene/toml/edited_text.hpp"
#include "hiac/scene/toml/spec_key.hpp"
#include "hiac/scene/toml/spec_text.hpp"
#include "hiac/session/starter/starter_camera.hpp"
#include "tools/common/run_files.hpp"
#include "tools/common/text_output.hpp"
#include "tools/view/transfer/apply_edit.hpp"
#include "tools/view/transfer/bump.hpp"
#include "tools/view/transfer/saved_curves.hpp"
#include "tools/view/transfer/transfer_text.hpp"

namespace hiac::view {
namespace {

/// The slider's ends are a hundredth and a hundred times the density.
constexpr int kDensitySteps = 200;
double factor_of(int value) {
  const double factor = std::pow(10, 2.0 * value / kDensitySteps);
  return starter::rounded(factor, factor);
}

QString field_of(const auto& transfer) {
  return transfer ? QString::fromStdString(transfer->field) : QString();
}

}  // namespace

TransferPanel::TransferPanel(Document& document, QWidget* parent)
    : QWidget(parent),
      document_(document),
      extinction_field_(new QComboBox),
      color_field_(new QComboBox),
      preset_(new QComboBox),
      to_points_(new QPushButton(tr("Points"))),
      curve_(new TransferCurve(document)),
      color_curve_(new TransferCurve(document)),
      density_(new QSlider(Qt::Horizontal)),
      factor_(new QLabel),
      depth_(new QLabel),
      log_counts_(new QCheckBox(tr("Log counts"))),
      log_values_(new QCheckBox(tr("Log values"))),
      tables_(new TransferTables(document)) {
  lay_out();
  connect_curve(*curve_, histogram_);
  connect_curve(*color_curve_, color_histogram_);
  connect(&document_, &Document::mesh_changed, this, &TransferPanel::fill_fields);
  connect(&document_, &Document::changed, this, &TransferPanel::show_document);
  connect(tables_, &TransferTables::row_chosen, this, [this](const ChosenHandle& handle) {
    for (TransferCurve* curve : {curve_, color_curve_})
      if (curve->place_of(handle)) curve->choose(handle);
  });
  show_depth(std::nullopt);
  fill_fields();
  show_document();
}

void TransferPanel::lay_out() {
  auto* plots = new QSplitter(Qt::Vertical);
  plots->addWidget(curve_);
  plots->addWidget(color_curve_);
  plots->addWidget(tables_);
  plots->setStretchFactor(0, 3);
  plots->setStretchFactor(1, 2);
  plots->setStretchFactor(2, 2);
  plots->setChildrenCollapsible(false);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(6, 6, 6, 6);
  layout->addWidget(make_choices());
  layout->addWidget(make_density());
  layout->addWidget(plots, 1);
  depth_->setToolTip(
      tr("The integral of the extinction, in the mean over the rays that meet the "
         "mesh, and the share of light that such a ray lets through"));
  layout->addWidget(depth_);
  layout->addWidget(make_buttons());
}

QWidget* TransferPanel::make_choices() {
  auto* choices = new QWidget;
  auto* grid = new QGridLayout(choices);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->addWidget(new QLabel(tr("Extinction by")), 0, 0);
  grid->addWidget(extinction_field_, 0, 1, 1, 2);
  grid->addWidget(new QLabel(tr("Colour by")), 1, 0);
  grid->addWidget(color_field_, 1, 1);
  grid->addWidget(preset_, 1, 2);
  grid->addWidget(to_points_, 1, 3);
  grid->setColumnStretch(1, 3);
  grid->setColumnStretch(2, 2);
  for (QComboBox* box : {extinction_field_, color_field_, preset_}) {
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    box->setMinimumContentsLength(8);
  }
  extinction_field_->setAccessibleName(tr("Field of the extinction"));
  color_field_->setAccessibleName(tr("Field of the colour"));
  preset_->setAccessibleName(tr("Colour map"));
  preset_->addItem(tr("(points)"));
  for (const std::string& name : built_in_colormap_names())
    preset_->addItem(QString::fromStdString(name));
  preset_->setToolTip(tr("A colour map by name, over the scalars that the colour spans now"));
  to_points_->setToolTip(
      tr("Turn the colour map into points that can be edited; the picture stays the same"));
  extinction_field_->setToolTip(tr("The field whose values decide the extinction"));
  color_field_->setToolTip(tr("The field whose values decide the colour"));
  connect(extinction_field_, &QComboBox::textActivated, this,
          &TransferPanel::choose_extinction_field);
  connect(color_field_, &QComboBox::textActivated, this, &TransferPanel::choose_color_field);
  connect(preset_, &QComboBox::activated, this, [this](int index) {
    if (index == 0)
      turn_into_points();
    else
      choose_preset(preset_->itemText(index));
  });
  connect(to_points_, &QPushButton::clicked, this, &TransferPanel::turn_into_points);
  return choices;
}

QWidget* TransferPanel::make_density() {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  density_->setRange(-kDensitySteps, kDensitySteps);
  density_->setToolTip(
      tr("Multiplies every extinction, by a hundredth to a hundred; comes back to the middle"));
  density_->setAccessibleName(tr("Density"));
  factor_->setMinimumWidth(fontMetrics().horizontalAdvance(QStringLiteral("× 100.00")));
  log_values_->setToolTip(
      tr("Values lie evenly in their logarithm; those that are not positive are not shown"));
  log_counts_->setToolTip(tr("The histogram's height is the logarithm of the volume"));
  layout->addWidget(new QLabel(tr("Density")));
  layout->addWidget(density_, 1);
  layout->addWidget(factor_);
  layout->addWidget(log_counts_);
  layout->addWidget(log_values_);
  connect(density_, &QSlider::valueChanged, this, &TransferPanel::slide_density);
  connect(density_, &QSlider::sliderReleased, this, [this] { density_->setValue(0); });
  connect(log_counts_, &QCheckBox::toggled, this, [this](bool on) {
    curve_->set_log_counts(on);
    color_curve_->set_log_counts(on);
  });
  connect(log_values_, &QCheckBox::toggled, this, [this](bool on) {
    curve_->set_log_values(on);
    color_curve_->set_log_values(on);
  });
  return row;
}

QWidget* TransferPanel::make_buttons() {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  const auto add = [&](const QString& text, const QString& tip, auto action) {
    auto* button = new QPushButton(text);
    button->setToolTip(tip);
    layout->addWidget(button);
    connect(button, &QPushButton::clicked, this, action);
  };
  add(tr("Add point"), tr("A point of the extinction at the chosen value (double click)"),
      [this] { curve_->add_point_here(); });
  add(tr("Add isosurface"), tr("An isosurface at the chosen value"),
      [this] { curve_->add_surface_here(); });
  add(tr("Remove"), tr("Remove the chosen point or isosurface (Delete)"), [this] {
    (color_curve_->chosen() && color_curve_->isVisible() ? color_curve_ : curve_)->remove_chosen();
  });
  layout->addStretch(1);
  const QString kinds = tr("Transfer functions (*.toml)");
  add(tr("Save..."), tr("Save colour and extinction in a file of their own"), [this, kinds] {
    const QString file = QFileDialog::getSaveFileName(this, tr("Save curves"), QString(), kinds);
    if (!file.isEmpty()) save_curves(file);
  });
  add(tr("Load..."), tr("Take colour and extinction from such a file, or from a specification"),
      [this, kinds] {
        const QString file =
            QFileDialog::getOpenFileName(this, tr("Load curves"), QString(), kinds);
        if (!file.isEmpty()) load_curves(file);
      });
  return row;
}

void TransferPanel::connect_curve(TransferCurve& curve, HistogramSource& source) {
  connect(&curve, &TransferCurve::values_shown, this, [this, &curve, &source] {
    if (document_.mesh() && !curve.field().empty())
      source.measure(document_.mesh(), curve.field(), curve.axes().values(), curve.axes().scale());
  });
  connect(&source, &HistogramSource::measured, &curve,
          [&curve](std::shared_ptr<const VolumeHistogram> histogram, const QString& field) {
            if (field.toStdString() == curve.field()) curve.show_histogram(std::move(histogram));
          });
  connect(&curve, &TransferCurve::handle_chosen, this,
          [this, &curve] { tables_->show_handle(curve.chosen()); });
  connect(&curve, &TransferCurve::color_wanted, tables_, &TransferTables::pick_color);
}

bool TransferPanel::is_at_rest() const {
  return histogram_.is_at_rest() && color_histogram_.is_at_rest();
}

void TransferPanel::fill_fields() {
  QStringList names;
  if (document_.mesh())
    for (const std::string& name : scalar_field_names(*document_.mesh()))
      names << QString::fromStdString(name);
  for (QComboBox* fields : {extinction_field_, color_field_}) {
    fields->clear();
    fields->addItems(names);
  }
  // another mesh has other values
  for (TransferCurve* curve : {curve_, color_curve_}) curve->show_field("", {0, 1});
}

void TransferPanel::show_extent(TransferCurve& curve, const std::string& field) {
  if (field == curve.field() || !document_.mesh()) return;
  try {
    const std::array<double, 2> extent = field_extent(document_, field);
    curve.show_field(field, extent);
  } catch (const Error& error) {
    Q_EMIT document_.message(QString::fromStdString(error.what()));
  }
}

void TransferPanel::show_document() {
  setEnabled(document_.has_scene());
  if (!document_.has_scene()) return;
  const Volume& volume = document_.scene().volume;
  const QString extinction = field_of(volume.extinction), color = field_of(volume.color);
  const auto show_name = [](QComboBox& fields, const QString& name) {
    // a formula's field or an abbreviation is not in the list
    if (!name.isEmpty() && fields.findText(name) < 0) fields.addItem(name);
    fields.setCurrentText(name);
    if (name.isEmpty()) fields.setCurrentIndex(-1);
  };
  show_name(*extinction_field_, extinction);
  show_name(*color_field_, color);
  const QString main = extinction.isEmpty() ? color : extinction;
  show_extent(*curve_, main.toStdString());
  const bool has_two = !color.isEmpty() && color != main;
  color_curve_->setVisible(has_two);
  if (has_two) show_extent(*color_curve_, color.toStdString());
  const QString preset = QString::fromStdString(preset_of(document_.text()));
  if (!preset.isEmpty() && preset_->findText(preset) < 0) preset_->addItem(preset);
  preset_->setCurrentIndex(preset.isEmpty() ? 0 : preset_->findText(preset));
  to_points_->setEnabled(volume.color && !has_plain_points<3>(document_.text()));
}

void TransferPanel::show_depth(std::optional<double> mean_optical_depth) {
  if (!mean_optical_depth)
    depth_->setText(tr("Optical depth along the mean ray: –"));
  else
    depth_->setText(tr("Optical depth along the mean ray: %1 (%2 % of the light passes)")
                        .arg(*mean_optical_depth, 0, 'g', 3)
                        .arg(100 * std::exp(-*mean_optical_depth), 0, 'g', 3));
}

void TransferPanel::choose_extinction_field(const QString& field) {
  apply_edit(document_, tr("extinction's field"), false, [&] {
    const std::string name = field.toStdString();
    const std::array<double, 2> extent = field_extent(document_, name);
    if (document_.scene().volume.extinction)
      return with_field<1>(document_.text(), document_.scene(), name, extent);
    const std::array<double, 2> row{extent[0], 1};
    const std::vector<std::pair<std::string, std::string>> keys{
        {"field", toml_text(name)}, {"points", "[" + toml_text(row) + "]"}};
    return with_table(document_.text(), "volume.extinction", keys);
  });
  show_document();
}

void TransferPanel::choose_color_field(const QString& field) {
  apply_edit(document_, tr("colour's field"), false, [&] {
    const std::string name = field.toStdString();
    const std::array<double, 2> extent = field_extent(document_, name);
    if (document_.scene().volume.color)
      return with_field<3>(document_.text(), document_.scene(), name, extent);
    return with_preset(document_.text(), document_.scene(), "viridis", name, extent);
  });
  show_document();
}

void TransferPanel::choose_preset(const QString& name) {
  apply_edit(document_, tr("colour map"), false, [&] {
    const Volume& volume = document_.scene().volume;
    const std::string field = volume.color        ? volume.color->field
                              : volume.extinction ? volume.extinction->field
                                                  : color_field_->itemText(0).toStdString();
    const std::array<double, 2> extent = field_extent(document_, field);
    return with_preset(document_.text(), document_.scene(), name.toStdString(), field, extent);
  });
  show_document();
}

void TransferPanel::turn_into_points() {
  if (!document_.has_scene() || !document_.scene().volume.color) return;
  apply_edit(document_, tr("colour map into points"), false,
             [&] { return with_plain_points<3>(document_.text(), document_.scene()); });
}

// Every step of a drag multiplies what stood where it began.
void TransferPanel::slide_density(int value) {
  factor_->setText(value == 0 ? QString()
                              : QStringLiteral("× %1").arg(factor_of(value), 0, 'g', 3));
  if (value == 0 || !document_.has_scene()) {
    undense_.clear();
    return;
  }
  const bool begins = undense_.empty();
  if (begins) undense_ = document_.text();
  apply_edit(document_, tr("density"), !begins,
             [&] { return with_density(undense_, factor_of(value)); });
  // by keys there is no drag, and no release
  if (!density_->isSliderDown()) density_->setValue(0);
}

void TransferPanel::save_curves(const QString& file) {
  try {
    const std::string path = file.toStdString();
    tools::require_safe({{document_.mesh_file(), document_.file()},
                         {{"save", path, tools::FileKind::specification}}});
    tools::write_text(path, saved_curves(document_.text(), document_.scene()));
  } catch (const Error& error) {
    Q_EMIT document_.message(QString::fromStdString(error.what()));
  }
}

void TransferPanel::load_curves(const QString& file) {
  apply_edit(document_, tr("load curves"), false, [&] {
    const std::string path = file.toStdString();
    return with_saved_curves(document_.text(), read_text_file(path), path);
  });
}

}  // namespace hiac::view
