#include "scabo/convert/deck_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "scabo/convert/deck_contacts.hpp"
#include "scabo/convert/deck_fields.hpp"
#include "scabo/convert/deck_materials.hpp"
#include "scabo/convert/deck_names.hpp"
#include "scabo/convert/deck_nodes.hpp"
#include "scabo/convert/deck_steps.hpp"
#include "scabo/convert/keyword_rules.hpp"
#include "scabo/convert/keywords.hpp"
#include "scabo/files/abaqus_lines.hpp"

namespace scabo::convert {

namespace {

using files::DeckBlock;
using files::DeckLine;
using files::DeckPlace;
using files::upper;

/// One load or prescribed displacement while the deck is read.
struct Growing {
  Given given;
  double value = 0.0;     // as the deck gives it last
  std::string amplitude;  // of this value, upper case
  bool touched = false;   // in this step
  bool fresh = true;      // new in this step
};
using Table = std::map<std::pair<int, int>, Growing>;

class ContentReader {
 public:
  ContentReader(const files::AbaqusDeck& deck, Remarks& remarks) : deck_(deck), mesh_(deck.mesh), remarks_(remarks) {
    for (const files::FacetSet& set : mesh_.facet_sets) facet_sets_.emplace(set.name, &set);
  }

  DeckContent read() {
    const std::vector<bool> left_out = blocks_left_out(deck_, remarks_);
    for (std::size_t b = 0; b < deck_.blocks.size(); ++b)
      if (!left_out[b]) keyword(deck_.blocks[b]);
    if (in_step_) end_step();
    for (auto* table : {&displacements_, &forces_, &pressures_}) {
      auto& to = table == &displacements_ ? content_.displacements
                 : table == &forces_      ? content_.forces
                                          : content_.pressures;
      for (auto& [key, growing] : *table)
        if (DeckReference* reference = nodes_.reference_of(key.first))
          (table == &displacements_ ? reference->displacements : reference->forces)
              .emplace(key.second, std::move(growing.given));
        else if (table == &displacements_ || !is_zero(growing.given.course))
          to.emplace(key, std::move(growing.given));
    }
    for (auto& load : body_loads_) {
      if (is_zero(load.x.given.course) && is_zero(load.y.given.course) && is_zero(load.z.given.course)) continue;
      content_.body_loads.push_back(
          {load.set, load.kind, std::move(load.x.given), std::move(load.y.given), std::move(load.z.given)});
    }
    for (auto& [key, growing] : temperatures_) content_.temperatures.emplace(key.first, std::move(growing.given));
    content_.references = nodes_.take_references();
    tell_left_out();
    return std::move(content_);
  }

 private:
  struct GrowingBodyLoad {
    std::string set;
    DeckBodyLoad::Kind kind;
    Growing x, y, z;
  };

  // ---- steps

  void begin_step(const DeckBlock& block) {
    if (in_step_) end_step();
    in_step_ = true;
    has_procedure_ = false;
    new_displacements_ = new_forces_ = new_pressures_ = new_temperatures_ = false;
    content_.steps.push_back(begun_step(block, told_of_large_displacements_, remarks_));
    told_of_large_displacements_ = told_of_large_displacements_ || asks_for_large_displacements(block);
  }

  void static_step(const DeckBlock& block) {
    if (!in_step_) return remarks_.essential(block.at, "*STATIC stands outside of a step; put *STEP before it");
    DeckStep& step = content_.steps.back();
    if (has_procedure_)
      remarks_.essential(block.at, "another procedure of this step stands before this *STATIC; leave one of them");
    has_procedure_ = true;
    read_static(block, step, remarks_);
  }

  Leg leg_of(const Growing& growing, double before) {
    if (growing.amplitude.empty()) return {growing.value, {}};
    if (content_.steps.back().at_once)
      remarks_.essential(growing.given.at,
                         "a load by an *AMPLITUDE in a step with AMPLITUDE=STEP is not taken; take out one of the two");
    const Amplitude& amplitude = amplitudes_.at(growing.amplitude);
    const double factor = amplitude.absolute ? 1.0 : growing.value;
    Leg leg = leg_along(amplitude, factor, amplitude.total_time ? total_time_ : 0.0, content_.steps.back().period);
    const double first = leg.table.front().second;
    if (std::abs(first - before) > 1e-9 * std::max({std::abs(first), std::abs(before), std::abs(factor)})) {
      remarks_.note(growing.given.at,
                    fmt::format("by its amplitude the value jumps from {:g} to {:g} at the begin of the step: it goes "
                                "there over the first increment",
                                before, first));
      begin_at(leg, before, first_part(content_.steps.back()));
    }
    if (leg.table.size() == 2) leg.table.clear();
    return leg;
  }

  void finish(Growing& growing, bool taken_back) {
    Course& course = growing.given.course;
    const std::size_t steps = content_.steps.size();
    course.resize(steps - 1);
    const double before = steps > 1 ? course.back().end : 0.0;
    if (!growing.touched && taken_back) growing.value = 0.0, growing.amplitude.clear();
    if (growing.given.removed >= 0) return course.push_back({before, {}});
    // An amplitude in total time goes on in later steps, one in step time does not.
    const bool goes_on = !growing.amplitude.empty() && amplitudes_.at(growing.amplitude).total_time;
    const bool from_outside = steps == 1 && growing.value != 0.0;  // displacements before the first step
    if (growing.touched || goes_on || from_outside)
      course.push_back(leg_of(growing, before));
    else
      course.push_back({taken_back ? 0.0 : before, {}});
    growing.touched = growing.fresh = false;
  }

  /// By OP=NEW supports end that the step does not give anew; in the first step they never act.
  void release_supports() {
    if (!new_displacements_) return;
    const auto step = static_cast<int>(content_.steps.size()) - 1;
    for (auto& [key, growing] : displacements_)
      if (!growing.touched && growing.given.removed < 0) growing.given.removed = step;
    std::erase_if(displacements_, [](const auto& of) { return of.second.given.removed == 0; });
  }

  /// What the step has of one of the keywords of distributed loads.
  struct DistributedLoads {
    bool before = false, here = false;       // given in an earlier step, in this one
    std::optional<files::DeckPlace> new_at;  // OP=NEW in this step
  };

  /// OP=NEW of one keyword takes back the loads of both in CalculiX, those of its own in Abaqus.
  void tell_what_is_removed(const DistributedLoads& loads, const DistributedLoads& others, std::string_view keyword) {
    if (loads.new_at && others.before && !others.new_at)
      remarks_.essential(
          *loads.new_at,
          fmt::format("OP=NEW takes back the loads that {} of earlier steps has given as well in CalculiX, and not in "
                      "Abaqus; say which is meant by {}, OP=NEW in this step, with the loads that stay",
                      keyword, keyword));
  }

  void end_step() {
    const DeckStep& step = content_.steps.back();
    if (!has_procedure_)
      remarks_.essential(step.at, "the step has no *STATIC, and Scabo converts static steps; add it");
    release_supports();
    for (auto& [key, growing] : displacements_) finish(growing, false);
    for (auto& [key, growing] : forces_) finish(growing, new_forces_);
    for (auto& [key, growing] : pressures_) finish(growing, new_pressures_);
    for (auto& [key, growing] : temperatures_) finish(growing, new_temperatures_);
    for (GrowingBodyLoad& load : body_loads_)
      for (Growing* component : {&load.x, &load.y, &load.z}) finish(*component, new_pressures_);
    tell_what_is_removed(dload_, dsload_, "*DSLOAD");
    tell_what_is_removed(dsload_, dload_, "*DLOAD");
    for (DistributedLoads* loads : {&dload_, &dsload_}) *loads = {loads->before || loads->here, false, {}};
    total_time_ += step.period;
    in_step_ = false;
  }

  // ---- loads and supports

  /// Amplitude of a block in upper case, empty if there is none; nothing if it is not known.
  std::optional<std::string> amplitude_of(const DeckBlock& block) {
    const std::string name = upper(parameter(block, "AMPLITUDE"));
    if (name.empty()) return name;
    if (amplitudes_.contains(name)) return delayed_amplitude(amplitudes_, name, block, remarks_);
    remarks_.essential(
        block.at, fmt::format("there is no usable *AMPLITUDE '{}', and the values of this keyword are lost; correct it",
                              files::printable(name)));
    return std::nullopt;
  }

  bool is_new(const DeckBlock& block) { return upper(parameter(block, "OP")) == "NEW"; }

  /// `adds`: to what the same step gave before.
  void grow(Growing& growing, double value, const std::string& amplitude, const DeckLine& line, bool adds) {
    if (growing.touched && adds && growing.amplitude != amplitude)
      remarks_.essential(
          line.at, "two values with different amplitudes act on the same place in one step; give them one amplitude");
    growing.value = growing.touched && adds ? growing.value + value : value;
    growing.amplitude = amplitude;
    growing.touched = true;
    growing.given.label = line.fields[0];
    growing.given.at = line.at;
  }

  /// Whether 0 times either of two amplitudes is meant.
  bool stays_zero(const Growing& growing, const std::string& amplitude) const {
    const auto is_relative = [&](const std::string& name) { return name.empty() || !amplitudes_.at(name).absolute; };
    return growing.value == 0.0 && is_relative(growing.amplitude) && is_relative(amplitude);
  }

  /// Programs differ in which of two values counts.
  void tell_other_value(const Growing& growing, int component, double value, const std::string& amplitude,
                        const DeckLine& line) {
    const bool same = growing.value == value && (growing.amplitude == amplitude || stays_zero(growing, amplitude));
    if (!in_step_ || !growing.touched || same) return;
    remarks_.essential(line.at,
                       fmt::format("in one step '{}' has the displacement {:g} along degree of freedom {}, and "
                                   "'{}', of the same node, {:g}; keep the one that is meant",
                                   files::printable(growing.given.label), growing.value, component + 1,
                                   files::printable(line.fields[0]), value));
  }

  void boundary(const DeckBlock& block) {
    const auto amplitude = amplitude_of(block);
    if (!amplitude) return;
    if (in_step_ && is_new(block)) new_displacements_ = true;
    for (const DeckLine& line : block.lines) {
      const auto held = held_freedoms(line, dimension_, remarks_);
      if (!held) continue;
      if (!in_step_ && held->value != 0.0 && !outside_of_steps_++)
        remarks_.note(line.at,
                      "a displacement that is not 0 stands outside of a step: it grows over the first one, as in "
                      "CalculiX (Abaqus has none)");
      for (const int node : nodes_.named(line, "the support", remarks_))
        for (const auto& at : nodes_.components_of(node, *held, line, remarks_)) {
          hold(displacements_[at], at.second, held->value, *amplitude, is_on(block, "FIXED"), line);
          if (!in_step_) displacements_[at].touched = false;
        }
    }
  }

  /// A displacement in a step, or of a support that is there from the start. `fixed`: held where it is then.
  void hold(Growing& growing, int component, double value, const std::string& amplitude, bool fixed,
            const DeckLine& line) {
    const auto step = static_cast<int>(content_.steps.size()) - 1;
    const bool begins = growing.given.label.empty() && in_step_ && step > 0;
    if (growing.given.removed >= 0)
      remarks_.essential(line.at,
                         fmt::format("the support ends in step {} by OP=NEW and begins again in step {}, which "
                                     "one of Scabo does not; give it to other nodes",
                                     growing.given.removed + 1, step + 1));
    else if (begins && !fixed)
      remarks_.essential(line.at,
                         fmt::format("the support begins in step {}, and moves its nodes from where they are then to a "
                                     "displacement from the start, while one of Scabo counts from there; write FIXED, "
                                     "if it holds them where they are",
                                     step + 1));
    if (begins) growing.given.added = step;
    if (fixed) value = growing.value;
    tell_other_value(growing, component, value, amplitude, line);
    grow(growing, value, amplitude, line, false);
  }

  void cload(const DeckBlock& block) {
    const auto amplitude = amplitude_of(block);
    if (!amplitude || !needs_step(block)) return;
    if (is_new(block)) new_forces_ = true;
    for (const DeckLine& line : block.lines) {
      const auto dof = number(remarks_, line, 1, "the degree of freedom"),
                 value = number(remarks_, line, 2, "the force");
      if (!dof || !value) continue;
      const bool whole = *dof >= 1.0 && *dof <= 6.0 && *dof == std::floor(*dof);
      for (const int node : nodes_.named(line, "the force", remarks_)) {
        const auto at = whole ? nodes_.component_at(node, static_cast<int>(*dof) - 1) : std::nullopt;
        if (at)
          grow(forces_[*at], *value, *amplitude, line, true);
        else if (*value != 0.0)
          remarks_.essential(line.at,
                             fmt::format("a load along degree of freedom {:g} does not act on a {} and is lost", *dof,
                                         node < 0 ? "reference node" : nodes_.body()));
      }
    }
  }

  // ---- temperatures of solids

  void initial_temperatures(const DeckBlock& block) {
    remarks_.note(block.at, "*INITIAL CONDITIONS of temperature are left out; they act by their changes only");
    if (!deck_.solid) return;
    for (const DeckLine& line : block.lines)
      if (const auto value = number(remarks_, line, 1, "the initial temperature"))
        for (const int node : nodes_.named(line, "the initial temperature", remarks_)) initial_[node] = *value;
  }

  void temperature(const DeckBlock& block) {
    const auto amplitude = amplitude_of(block);
    if (!amplitude || !needs_step(block)) return;
    for (const auto& [name, value] : block.parameters)
      if (name != "OP" && name != "AMPLITUDE")
        remarks_.essential(block.at, fmt::format("*TEMPERATURE with {} is not taken; write the values as numbers",
                                                 files::printable(name)));
    if (is_new(block)) new_temperatures_ = true;
    for (const DeckLine& line : block.lines) {
      const auto value = number(remarks_, line, 1, "the temperature");
      if (!value) continue;
      for (const int node : nodes_.named(line, "the temperature", remarks_)) {
        const auto initial = initial_.find(node);
        const double before = initial == initial_.end() ? 0.0 : initial->second;
        if (!amplitude->empty() && before != 0.0)
          remarks_.essential(line.at,
                             "a temperature by an *AMPLITUDE with an initial one that is not 0 is not taken; count "
                             "temperatures from the initial one");
        grow(temperatures_[{node, 0}], *value - before, *amplitude, line, false);
      }
    }
  }

  std::optional<std::vector<files::Facet>> sides_of_line(const DeckLine& line) const {
    const auto found = facet_sets_.find(line.sides);
    return found == facet_sets_.end() ? std::nullopt : std::optional(found->second->facets);
  }

  void press(const std::vector<files::Facet>& sides, double value, const std::string& amplitude, const DeckLine& line) {
    for (const files::Facet& side : sides) grow(pressures_[key_of(side)], value, amplitude, line, true);
  }

  void body_load(const DeckLine& line, DeckBodyLoad::Kind kind, const Eigen::Vector3d& value,
                 const std::string& amplitude) {
    auto found = std::find_if(body_loads_.begin(), body_loads_.end(), [&](const GrowingBodyLoad& load) {
      return load.kind == kind && upper(load.set) == upper(line.fields[0]);
    });
    if (found == body_loads_.end()) found = body_loads_.insert(found, {line.fields[0], kind, {}, {}, {}});
    Growing* const components[] = {&found->x, &found->y, &found->z};
    for (int k = 0; k < 3; ++k) grow(*components[k], value[k], amplitude, line, true);
  }

  /// Whether a line of *DLOAD has no more entries than its type takes.
  bool has_its_entries(const DeckLine& line, const std::string& label) {
    const std::size_t most = label == "CENTRIF" ? 9 : label == "GRAV" ? 6 : 3;
    if (line.fields.size() > most)
      remarks_.essential(line.at,
                         fmt::format("a load of type '{}' takes {} entries, and '{}' is one more; take it out",
                                     files::printable(line.fields[1]), most, files::printable(line.fields[most])));
    return line.fields.size() <= most;
  }

  void dload(const DeckBlock& block) {
    const auto amplitude = amplitude_of(block);
    if (!amplitude || !needs_step(block)) return;
    const bool of_surface = block.name == "DSLOAD";
    DistributedLoads& loads = of_surface ? dsload_ : dload_;
    loads.here = true;
    if (is_new(block)) {
      new_pressures_ = true;
      loads.new_at = block.at;
    }
    for (const DeckLine& line : block.lines) {
      const std::string label = line.fields.size() > 1 ? upper(line.fields[1]) : "";
      const bool pressure = !line.sides.empty() || (of_surface && label == "P");
      const bool taken = pressure || label == "GRAV" || label == "BX" || label == "BY" || label == "CENTRIF" ||
                         (dimension_ == 3 && label == "BZ");
      if (taken && !has_its_entries(line, label)) continue;
      if (pressure) {
        const auto value = number(remarks_, line, 2, "the pressure");
        const auto sides = line.sides.empty() ? surface_named(deck_, line.fields[0]) : sides_of_line(line);
        if (!sides && sides_named(deck_, line.fields[0]))
          remarks_.essential(line.at,
                             fmt::format("'{}' has nodes and no sides of elements, and the pressure on it is lost; "
                                         "give a *SURFACE, TYPE=ELEMENT",
                                         files::printable(line.fields[0])));
        else if (!sides)
          remarks_.essential(line.at, fmt::format("there is no surface '{}' with sides of {}s, and the "
                                                  "pressure on it is lost; correct its name",
                                                  files::printable(line.fields[0]), nodes_.element()));
        else if (value)
          press(*sides, *value, *amplitude, line);
      } else if (label == "GRAV") {
        if (const auto g = gravity_of(remarks_, line, dimension_))
          body_load(line, DeckBodyLoad::Kind::gravity, *g, *amplitude);
      } else if (label == "BX" || label == "BY" || (dimension_ == 3 && label == "BZ")) {
        const auto value = number(remarks_, line, 2, "the force per volume");
        if (value)
          body_load(line, DeckBodyLoad::Kind::body_force, *value * Eigen::Vector3d::Unit(label[1] - 'X'), *amplitude);
      } else if (label == "CENTRIF") {
        if (const auto square = rotation_of(remarks_, line))
          body_load(line, DeckBodyLoad::Kind::rotation, {*square, 0.0, 0.0}, *amplitude);
      } else {
        remarks_.essential(
            line.at, fmt::format("a distributed load of type '{}' is not taken; there are {}", files::printable(label),
                                 of_surface        ? "P"
                                 : dimension_ == 3 ? "P1 to P6 and GRAV"
                                                   : "P1 to P4, GRAV, CENTRIF, BX and BY"));
      }
    }
  }

  bool needs_step(const DeckBlock& block) {
    if (!in_step_)
      remarks_.essential(block.at,
                         fmt::format("{} stands outside of a step and is lost; give it within *STEP", block.written));
    return in_step_;
  }

  // ---- keywords

  void keyword(const DeckBlock& block) {
    check_block(block, remarks_);
    const std::string& name = block.name;
    if (block.instance >= 0 && !belongs_to_part(name))
      remarks_.essential(block.at, fmt::format("{} stands within a part; give it after *END ASSEMBLY, as only meshes, "
                                               "sections and orientations belong there",
                                               block.written));
    if (name == "HEADING") {
      if (!block.lines.empty() && content_.title.empty())
        for (const std::string& field : block.lines[0].fields)
          content_.title += (content_.title.empty() ? "" : ", ") + field;
    } else if (name == "STEP") {
      begin_step(block);
    } else if (name == "STATIC") {
      static_step(block);
    } else if (name == "ENDSTEP") {
      if (in_step_) end_step();
    } else if (name == "BOUNDARY") {
      boundary(block);
    } else if (name == "CLOAD") {
      cload(block);
    } else if (name == "DLOAD" || name == "DSLOAD") {
      dload(block);
    } else if (name == "INITIALCONDITIONS" && upper(parameter(block, "TYPE")) == "TEMPERATURE") {
      initial_temperatures(block);
    } else if (name == "CLEARANCE" && deck_.solid) {
      contacts_.clearance(block, in_step_);
    } else if (name == "TEMPERATURE" && deck_.solid) {
      temperature(block);
    } else if (name != "AMPLITUDE" && !read_material_block(deck_, block, content_, remarks_) &&
               !contacts_.read(block, in_step_)) {
      other(block);
    }
  }

  static bool belongs_to_part(const std::string& name) {
    return name.ends_with("SECTION") || name == "ORIENTATION" || text_of_keyword(name).loss != KeywordLoss::essential;
  }

  void other(const DeckBlock& block) {
    if (deck_.solid && is_of_reference(block.name)) return;
    const KeywordText text = text_of_keyword(block.name);
    if (text.text.find("static analysis; Scabo converts") != std::string::npos) has_procedure_ = true;
    if (text.loss == KeywordLoss::note) left_out_[block.name].push_back(&block);
    if (text.loss != KeywordLoss::essential) return;
    const bool of_material = is_of_material(block.name) && !content_.materials.empty();
    remarks_.essential(block.at, of_material ? fmt::format("{} of material '{}' {}", block.written,
                                                           files::printable(content_.materials.back().name), text.text)
                                             : fmt::format("{} {}", block.written, text.text));
  }

  /// One sentence for each keyword that nothing depends on, however often it stands in the deck.
  void tell_left_out() {
    for (const auto& [name, blocks] : left_out_) {
      const std::string more = blocks.size() > 1 ? fmt::format(" (and {} more)", blocks.size() - 1) : "";
      remarks_.note(blocks.front()->at,
                    fmt::format("{}{} {}", blocks.front()->written, more, text_of_keyword(name).text));
    }
  }

  const files::AbaqusDeck& deck_;
  const files::ImportedMesh& mesh_;
  const int dimension_ = deck_.solid ? 3 : 2;
  Remarks& remarks_;
  DeckNodes nodes_{deck_, deck_.solid ? references_of(deck_, remarks_) : std::vector<DeckReference>{}};
  std::unordered_map<std::string, const files::FacetSet*> facet_sets_;
  std::map<std::string, Amplitude> amplitudes_ = read_amplitudes(deck_, remarks_);
  std::map<std::string, std::vector<const DeckBlock*>> left_out_;
  DeckContent content_;
  Table displacements_, forces_, pressures_, temperatures_;
  std::vector<GrowingBodyLoad> body_loads_;
  ContactReader contacts_{content_, remarks_, [this](const std::string& name) { return nodes_named(deck_, name); }};
  bool in_step_ = false, has_procedure_ = false, told_of_large_displacements_ = false;
  int outside_of_steps_ = 0;  // lines of displacements before the first step
  bool new_displacements_ = false, new_forces_ = false, new_pressures_ = false,
       new_temperatures_ = false;  // OP=NEW in this step
  std::map<int, double> initial_;  // temperatures, by node
  DistributedLoads dload_, dsload_;
  double total_time_ = 0.0;
};

}  // namespace

DeckContent read_content(const files::AbaqusDeck& deck, bool rigid_contact, Remarks& remarks) {
  DeckContent content = ContentReader(deck, remarks).read();
  for (auto& [name, interaction] : content.interactions) interaction.rigid = rigid_contact;
  tell_unknown_interactions(content, remarks);
  return content;
}

}  // namespace scabo::convert
