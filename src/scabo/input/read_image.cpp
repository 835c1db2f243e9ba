// `shape: {image: {file: core.png, pixel: 1e-4, materials: {0: matrix, 255: aggregate}}}`: a body that an image shows.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include "scabo/files/png.hpp"
#include "scabo/input/reading.hpp"

namespace scabo::input {

namespace {

constexpr const char* image_example = "{file: core.png, pixel: 1e-4, materials: {0: matrix, 255: aggregate}}";

/// Levels of an image and how many pixels have them.
std::map<int, long> levels_of(const files::Image& image) {
  std::map<int, long> count;
  for (const int level : image.labels) ++count[level];
  return count;
}

/// `0, 3-7, 255`: levels that follow each other are one range.
std::string list_of(const std::map<int, long>& levels) {
  std::string text;
  int shown = 0;
  for (auto first = levels.begin(); first != levels.end();) {
    auto last = first;
    auto next = std::next(last);
    while (next != levels.end() && next->first == last->first + 1) last = next++;
    if (shown++ == 8) return text + ", ...";
    text += fmt::format("{}{}", text.empty() ? "" : ", ", first->first);
    if (last != first) text += fmt::format("-{}", last->first);
    first = next;
  }
  return text;
}

/// A key of `materials`: `128`, or `0-127` for all levels from 0 to 127.
struct Levels {
  int first = 0, last = 0;
};

std::optional<int> level_of(std::string_view text) {
  if (text.empty() || text.size() > 5 || text.find_first_not_of("0123456789") != std::string_view::npos) return {};
  return std::stoi(std::string(text));
}

std::optional<Levels> levels_of(std::string_view key) {
  const std::size_t dash = key.find('-');
  const auto first = level_of(key.substr(0, dash));
  const auto last = dash == std::string_view::npos ? first : level_of(key.substr(dash + 1));
  if (!first || !last) return {};
  return Levels{*first, *last};
}

/// The materials of the levels that the image has, and the levels that are named.
class LevelReader {
 public:
  LevelReader(Reading& reading, const files::PngImage* image) : reading_(reading) {
    if (image == nullptr) return;
    present_ = levels_of(*image);
    largest_ = image->largest_label;
  }

  std::map<int, int> read(const Value& value) {
    if (value.node->kind != Node::Kind::map || value.node->entries.empty()) {
      reading_.report.error(value, "must be a map from levels of grey to materials, as in {0: matrix, 255: aggregate}");
      return {};
    }
    const std::size_t before = reading_.report.count();
    for (const MapEntry& entry : value.node->entries) read(entry.key, Value{entry.value, value.path + "." + entry.key});
    if (reading_.report.count() == before && materials_.empty() && !present_.empty())
      reading_.report.error(value, "no pixel of the image gets a material: name one for a level that it has");
    tell_of_empty_pixels(value);
    return materials_;
  }

 private:
  void read(const std::string& key, const Value& named) {
    const auto levels = levels_of(key);
    if (!levels)
      return reading_.report.error(named, fmt::format("'{}' is not a level of grey: write a whole number, 0 to 255, or "
                                                      "a range as in 0-127",
                                                      key));
    if (const std::string wrong = why_wrong(*levels); !wrong.empty()) return reading_.report.error(named, wrong);
    named_.emplace_back(*levels, key);
    const bool empty = stands_for_empty(named);
    const auto material = empty ? std::nullopt : read_material_name(reading_, named);
    const auto first = present_.lower_bound(levels->first), last = present_.upper_bound(levels->last);
    if (first == last) tell_of_absence(key, *levels, named);
    for (auto level = first; level != last; ++level)
      if (material) materials_[level->first] = *material;
  }

  std::string why_wrong(const Levels& levels) const {
    if (levels.last < levels.first)
      return fmt::format("a range begins with its lowest level: write {}-{}", levels.last, levels.first);
    if (largest_ && levels.last > *largest_)
      return fmt::format("no pixel can have the level {}, because those of this image are from 0 to {}: leave it out",
                         levels.last, *largest_);
    for (const auto& [other, key] : named_) {
      const int first = std::max(levels.first, other.first), last = std::min(levels.last, other.last);
      if (first == last) return fmt::format("the level {} is also one of '{}': give every level once", first, key);
      if (first < last)
        return fmt::format("the levels {} to {} are also of '{}': give every level once", first, last, key);
    }
    return "";
  }

  bool is_named(int level) const {
    return std::any_of(named_.begin(), named_.end(),
                       [&](const auto& named) { return named.first.first <= level && level <= named.first.last; });
  }

  /// Pixels that are meant to be empty, unless a material has this name.
  bool stands_for_empty(const Value& named) const {
    return named.node->kind == Node::Kind::scalar && named.node->text == "empty" &&
           !reading_.index_of_material.contains(named.node->text);
  }

  /// A range may be a threshold for several images; a single level is meant to exist.
  void tell_of_absence(const std::string& key, const Levels& levels, const Value& named) {
    if (present_.empty()) return;
    if (levels.first == levels.last)
      return reading_.report.error(
          named, fmt::format("no pixel of the image has the level {}: it has {}", key, list_of(present_)));
    reading_.model.warnings.push_back(
        {WarningKind::input, named.path,
         fmt::format("{}: no pixel of the image has one of these levels: it has {}", named.path, list_of(present_))});
  }

  void tell_of_empty_pixels(const Value& value) {
    std::map<int, long> left;
    long pixels = 0, all = 0;
    for (const auto& [level, count] : present_) {
      all += count;
      if (is_named(level)) continue;
      left.emplace(level, count);
      pixels += count;
    }
    if (left.empty()) return;
    reading_.model.warnings.push_back(
        {WarningKind::input, value.path,
         fmt::format("{}: {} of {} pixels are empty, because their {} no material: give them one, alone or in a range "
                     "as in 0-127, or write 'empty' for levels that are to stay so",
                     value.path, pixels, all,
                     left.size() == 1 ? fmt::format("level, {}, has", list_of(left))
                                      : fmt::format("{} levels, {}, have", left.size(), list_of(left)))});
  }

  Reading& reading_;
  std::map<int, long> present_;                        // levels of the image; empty if it could not be read
  std::optional<int> largest_;                         // that a pixel of the image can have
  std::vector<std::pair<Levels, std::string>> named_;  // with their keys
  std::map<int, int> materials_;
};

}  // namespace

std::optional<Outline> read_image(Reading& reading, const Value& value, Body& body) {
  Report& report = reading.report;
  const std::size_t before = report.count();
  const MapReader map(report, value, {"file", "pixel", "materials", "corner"}, image_example);
  ImageShape shape;
  std::shared_ptr<files::PngImage> image;
  const auto file_value = map.need("file");
  if (const auto name = file_value ? read_text(report, *file_value) : std::nullopt) {
    const std::filesystem::path beside = std::filesystem::path(reading.model.file).parent_path();
    reading.model.files.push_back((beside / *name).string());
    try {
      image = std::make_shared<files::PngImage>(files::read_png((beside / *name).string()));
    } catch (const InputError& error) {
      report.error(*file_value, fmt::format("{}: {}", *name, error.diagnostics().front().message));
    }
  }
  if (image && image->transparent > 0)
    reading.model.warnings.push_back(
        {WarningKind::input, file_value->path,
         fmt::format(
             "{}: {} of {} pixels are transparent, and count by their level of grey as if they were not: paint those "
             "that are to be empty in a grey of their own",
             file_value->path, image->transparent, image->labels.size())});
  if (const auto pixel = map.need("pixel")) {
    shape.pixel = read_number(report, *pixel).value_or(1.0);
    if (!(shape.pixel > 0.0)) report.error(*pixel, "must be greater than 0: it is the length of the side of a pixel");
  }
  if (const auto at = map.get("corner")) shape.corner = read_vector(report, *at).value_or(Vec2::Zero());
  if (const auto materials = map.need("materials"))
    shape.materials = LevelReader(reading, image.get()).read(*materials);
  if (report.count() > before || image == nullptr) return {};
  shape.image = image;
  body.image = shape;
  body.material = shape.materials.begin()->second;
  const PixelRectangle all = rectangle_of(shape);
  return rectangle_outline(shape.corner + shape.pixel * Vec2(all.left, all.bottom),
                           shape.pixel * Vec2(all.right - all.left, all.top - all.bottom), value.source());
}

}  // namespace scabo::input
