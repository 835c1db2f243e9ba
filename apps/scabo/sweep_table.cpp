#include "sweep_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "scabo/result/contact_table.hpp"

namespace scabo::app {

namespace {

using Json = nlohmann::ordered_json;

std::string cell_of(const Json& value) {
  if (value.is_number_float()) return fmt::format("{}", value.get<double>());
  if (value.is_number()) return value.dump();
  return "";
}

class RowReader {
 public:
  explicit RowReader(SweepRow& row) : row_(row) {}

  void add(const std::string& column, const Json& value) {
    row_.order.push_back(column);
    row_.values[column] = cell_of(value);
  }

  /// The numbers in a map, as `prefix.key`.
  void add_numbers(const std::string& prefix, const Json& map, const std::set<std::string>& without = {}) {
    if (!map.is_object()) return;
    for (const auto& [key, value] : map.items())
      if ((value.is_number() || value.is_null()) && !without.contains(key)) add(prefix + "." + key, value);
  }

  /// `prefix_x` and `prefix_y`, and in space `prefix_z`; empty if there is none.
  void add_vector(const std::string& prefix, const Json& vector) {
    const bool there = vector.is_array() && (vector.size() == 2 || vector.size() == 3);
    add(prefix + "_x", there ? vector[0] : Json());
    add(prefix + "_y", there ? vector[1] : Json());
    if (there && vector.size() == 3) add(prefix + "_z", vector[2]);
  }

  void add_increment(const Json& increment) {
    // Named, because a loop does not keep temporaries alive.
    const Json contacts = increment.value("contacts", Json::object()),
               reactions = increment.value("reactions", Json::object()),
               cracks = increment.value("cracks", Json::object());
    for (const auto& [name, contact] : contacts.items()) {
      add_numbers(name, contact, {"first_pair_in_contact", "last_pair_in_contact", "centre_of_pressure"});
      if (in_space(contact)) {
        for (const char* key : {"normal_force", "tangential_force", "moment"})
          add_vector(name + "." + key, contact.value(key, Json()));
        continue;
      }
      add_vector(name + ".force", contact.value("force", Json()));
      add_vector(name + ".centre", contact.value("centre_of_pressure", Json()));
    }
    for (const auto& [name, reaction] : reactions.items()) {
      add_vector(name + ".reaction", reaction);
    }
    const Json preloads = increment.value("preloads", Json::object());
    for (const auto& [name, preload] : preloads.items()) add_numbers(name + ".preload", preload);
    add_numbers("energy", increment.value("energy", Json()));
    for (const auto& [name, crack] : cracks.items())
      for (const char* key : {"K_I", "K_II", "K_tt", "K_rt"})
        if (crack.contains(key)) add(name + "." + key, crack[key]);
  }

  /// Of bodies of revolution the angle whose forces these are.
  void add_radians(const Json& model) {
    if (model.contains("forces_of"))
      add("forces_of_radians", model["forces_of"] == "one radian" ? 1.0 : 2.0 * std::numbers::pi);
  }

 private:
  static bool in_space(const Json& contact) {
    return contact.contains("normal_force") && contact["normal_force"].is_array();
  }

  SweepRow& row_;
};

}  // namespace

bool is_finished(const SweepRow& row) {
  return row.status == "solved" || row.status == "not_converged" || row.status == "mechanism" ||
         row.status == "collapse";
}

SweepRow row_of(const std::filesystem::path& results) {
  SweepRow row;
  std::ifstream stream(results / "summary.json", std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  const Json summary = Json::parse(text, nullptr, false);
  if (!summary.is_object() || !summary.contains("status") || !summary["status"].is_string()) return row;
  row.status = summary["status"].get<std::string>();
  if (row.status == "running") row.status = "interrupted";  // it was killed
  const Json increments = summary.value("increments", Json::array());
  const Json* last = nullptr;
  for (const Json& increment : increments)
    if (increment.value("converged", false)) last = &increment;
  if (last == nullptr) return row;
  row.step = cell_of(last->value("step", Json()));
  row.reached = cell_of(last->value("reached", Json()));
  if (row.status != "solved") return row;
  RowReader reader(row);
  reader.add_increment(*last);
  reader.add_radians(summary.value("model", Json::object()));
  const Json histories = summary.value("history", Json::object());
  for (const auto& [name, history] : histories.items()) reader.add_numbers(name, history);
  return row;
}

std::string sweep_table(const std::vector<SweepAxis>& axes, const std::vector<SweepRow>& rows) {
  std::vector<std::string> columns;
  std::set<std::string> known;
  for (const SweepRow& row : rows)
    for (const std::string& column : row.order)
      if (known.insert(column).second) columns.push_back(column);
  std::string table = "point";
  for (const SweepAxis& axis : axes) table += "," + result::csv_quoted(axis.path);
  table += ",status,step,reached";
  for (const std::string& column : columns) table += "," + result::csv_quoted(column);
  table += "\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const SweepRow& row = rows[i];
    table += std::to_string(i + 1);
    for (const std::string& value : values_at(axes, i)) table += "," + result::csv_quoted(value);
    table += fmt::format(",{},{},{}", row.status, row.step, row.reached);
    for (const std::string& column : columns) {
      const auto found = row.values.find(column);
      table += "," + (found == row.values.end() ? std::string() : found->second);
    }
    table += "\n";
  }
  return table;
}

}  // namespace scabo::app
