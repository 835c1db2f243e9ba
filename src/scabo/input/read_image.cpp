// `shape: {image: {file: core.png, pixel: 1e-4, materials: {0: matrix, 255: aggregate}}}`: a body that an image shows.
#include <fmt/format.h>

#include <filesystem>

#include "scabo/files/png.hpp"
#include "scabo/input/reading.hpp"

namespace scabo::input {

namespace {

constexpr const char* image_example = "{file: core.png, pixel: 1e-4, materials: {0: matrix, 255: aggregate}}";

/// Labels of an image and how many pixels have them.
std::map<int, long> labels_of(const files::Image& image) {
  std::map<int, long> count;
  for (const int label : image.labels) ++count[label];
  return count;
}

std::string list_of(const std::map<int, long>& labels) {
  std::string text;
  int shown = 0;
  for (const auto& [label, count] : labels) {
    if (shown++ == 8) return text + ", ...";
    text += fmt::format("{}{}", text.empty() ? "" : ", ", label);
  }
  return text;
}

/// A material for each label.
std::map<int, int> read_materials_of_labels(Reading& reading, const Value& value, const files::Image* image) {
  std::map<int, int> materials;
  if (value.node->kind != Node::Kind::map || value.node->entries.empty()) {
    reading.report.error(value, "must be a map from levels of grey to materials, as in {0: matrix, 255: aggregate}");
    return materials;
  }
  const std::map<int, long> labels = image != nullptr ? labels_of(*image) : std::map<int, long>{};
  for (const MapEntry& entry : value.node->entries) {
    const Value named{entry.value, value.path + "." + entry.key};
    const bool number =
        !entry.key.empty() && entry.key.size() < 6 && entry.key.find_first_not_of("0123456789") == std::string::npos;
    if (!number) {
      reading.report.error(named,
                           fmt::format("'{}' is not a level of grey: write a whole number, 0 to 255", entry.key));
      continue;
    }
    const int label = std::stoi(entry.key);
    const auto material = read_material_name(reading, named);
    if (image != nullptr && !labels.contains(label))
      reading.report.error(named,
                           fmt::format("no pixel of the image has the level {}: it has {}", label, list_of(labels)));
    if (material) materials[label] = *material;
  }
  return materials;
}

}  // namespace

std::optional<Outline> read_image(Reading& reading, const Value& value, Body& body) {
  Report& report = reading.report;
  const std::size_t before = report.count();
  const MapReader map(report, value, {"file", "pixel", "materials", "corner"}, image_example);
  ImageShape shape;
  std::shared_ptr<files::Image> image;
  const auto file_value = map.need("file");
  if (const auto name = file_value ? read_text(report, *file_value) : std::nullopt) {
    const std::filesystem::path beside = std::filesystem::path(reading.model.file).parent_path();
    reading.model.files.push_back((beside / *name).string());
    try {
      image = std::make_shared<files::Image>(files::read_png((beside / *name).string()));
    } catch (const InputError& error) {
      report.error(*file_value, fmt::format("{}: {}", *name, error.diagnostics().front().message));
    }
  }
  if (const auto pixel = map.need("pixel")) {
    shape.pixel = read_number(report, *pixel).value_or(1.0);
    if (!(shape.pixel > 0.0)) report.error(*pixel, "must be greater than 0: it is the length of the side of a pixel");
  }
  Vec2 corner = Vec2::Zero();
  if (const auto at = map.get("corner")) corner = read_vector(report, *at).value_or(Vec2::Zero());
  if (const auto materials = map.need("materials"))
    shape.materials = read_materials_of_labels(reading, *materials, image.get());
  if (report.count() > before || image == nullptr) return {};
  shape.image = image;
  body.image = shape;
  body.material = shape.materials.begin()->second;
  return rectangle_outline(corner, shape.pixel * Vec2(image->width, image->height), value.source());
}

}  // namespace scabo::input
