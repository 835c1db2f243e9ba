#include "scabo/convert/keyword_rules.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scabo/convert/deck_fields.hpp"
#include "scabo/files/abaqus_lines.hpp"
#include "scabo/files/text_cursor.hpp"

namespace scabo::convert {

namespace {

using files::DeckBlock;
using files::DeckLine;
using Use = ParameterUse;
using Parameters = std::vector<ParameterRule>;

std::vector<std::string> values_of(const std::string& text) {
  std::vector<std::string> values;
  std::size_t first = 0;
  while (!text.empty() && first <= text.size()) {
    const std::size_t end = std::min(text.find('|', first), text.size());
    values.push_back(text.substr(first, end - first));
    first = end + 1;
  }
  return values;
}

ParameterRule takes(const std::string& name, const std::string& values = "") {
  return {name, Use::taken, values_of(values), ""};
}
ParameterRule harmless(const std::string& name, const std::string& values = "") {
  return {name, Use::harmless, values_of(values), ""};
}
ParameterRule refuses(const std::string& name, const std::string& why) { return {name, Use::refused, {}, why}; }

using Rules = std::map<std::string, KeywordRule>;

void add_mesh_rules(Rules& rules) {
  rules["NODE"] = {DataLines::needed, 4, 0, {takes("NSET"), takes("INPUT"), takes("SYSTEM", "R")}};
  rules["ELEMENT"] = {DataLines::needed, 0, 0, {takes("TYPE"), takes("ELSET"), takes("INPUT")}};
  rules["NSET"] = {DataLines::needed_unless_elset,
                   0,
                   0,
                   {takes("NSET"), takes("ELSET"), takes("GENERATE"), takes("INSTANCE"), takes("INPUT"),
                    harmless("INTERNAL"), harmless("UNSORTED")}};
  rules["ELSET"] = {DataLines::needed,
                    0,
                    0,
                    {takes("ELSET"), takes("GENERATE"), takes("INSTANCE"), takes("INPUT"), harmless("INTERNAL"),
                     harmless("UNSORTED")}};
  rules["SURFACE"] = {DataLines::needed,
                      2,
                      0,
                      {takes("NAME"), takes("TYPE", "ELEMENT|NODE"), harmless("INTERNAL"), harmless("NO THICK"),
                       harmless("NO OFFSET")}};
  rules["PART"] = {DataLines::optional, 0, 0, {takes("NAME")}};
  rules["ASSEMBLY"] = {DataLines::optional, 0, 0, {harmless("NAME")}};
  rules["INSTANCE"] = {DataLines::optional, 7, 2, {takes("NAME"), takes("PART")}};
  rules["TRANSFORM"] = {DataLines::needed, 6, 1, {takes("NSET"), takes("TYPE", "R|C")}};
}

void add_material_rules(Rules& rules) {
  const auto dependent = refuses("DEPENDENCIES", "depends on field variables, which Scabo's materials do not");
  rules["MATERIAL"] = {DataLines::optional, 0, 0, {takes("NAME"), harmless("RTOL"), harmless("SRATE FACTOR")}};
  rules["ELASTIC"] = {DataLines::needed, 0, 0, {takes("TYPE"), harmless("MODULI"), dependent}};
  rules["DENSITY"] = {DataLines::needed, 0, 0, {dependent}};
  rules["EXPANSION"] = {DataLines::needed, 0, 0, {takes("TYPE"), harmless("ZERO"), dependent}};
  rules["ORIENTATION"] = {DataLines::needed,
                          6,
                          2,
                          {takes("NAME"), takes("SYSTEM", "RECTANGULAR|R"), harmless("DEFINITION", "COORDINATES")}};
  rules["SOLIDSECTION"] = {DataLines::optional,
                           1,
                           1,
                           {takes("ELSET"), takes("MATERIAL"), takes("ORIENTATION"), harmless("CONTROLS"),
                            harmless("OFFSET"),  // out of the plane
                            refuses("COMPOSITE", "has layers; give one material"),
                            refuses("NODAL THICKNESS", "varies the thickness, and a model has one"),
                            refuses("REF NODE", "is a generalised plane strain, which Scabo does not have")}};
}

void add_contact_rules(Rules& rules) {
  rules["SURFACEINTERACTION"] = {DataLines::optional,
                                 0,
                                 0,
                                 {takes("NAME"), harmless("UNSYMM"),
                                  refuses("PAD THICKNESS", "changes the gap; give `gap` to the contact of the model"),
                                  refuses("USER", "is a law of a program of its own")}};
  rules["SURFACEBEHAVIOR"] = {
      DataLines::optional,
      0,
      0,
      {takes("PRESSURE-OVERCLOSURE", "HARD|LINEAR|TABULAR|TIED|EXPONENTIAL"), harmless("PENALTY"),
       harmless("AUGMENTED LAGRANGE"), harmless("DIRECT"),
       refuses("NO SEPARATION", "is contact that does not open; `bond` of a contact may replace it")}};
  rules["FRICTION"] = {DataLines::needed,
                       4,
                       1,
                       {harmless("SLIP TOLERANCE"), harmless("ELASTIC SLIP"), harmless("LAGRANGE"),
                        refuses("ROUGH", "is not taken; give a coefficient"),
                        refuses("TAUMAX", "bounds the shear stress; `shear_strength` of a contact may replace it"),
                        refuses("EXPONENTIAL DECAY", "depends on the speed of slip; give a coefficient"),
                        refuses("ANISOTROPIC", "depends on the direction; give one coefficient"),
                        refuses("USER", "is a law of a program of its own; give a coefficient"),
                        refuses("DEPENDENCIES", "depends on field variables; give one coefficient")}};
  rules["CHANGEFRICTION"] = {DataLines::optional, 0, 0, {takes("INTERACTION")}};
  rules["CONTACTPAIR"] = {DataLines::needed,
                          2,
                          0,
                          {takes("INTERACTION"), takes("ADJUST"),
                           harmless("TYPE", "NODE TO SURFACE|SURFACE TO SURFACE|MORTAR|LINMORTAR|PGLINMORTAR"),
                           harmless("SMALL SLIDING"), harmless("NO THICKNESS"), harmless("HCRIT"), harmless("TRACKING"),
                           harmless("SUPPLEMENTARY CONSTRAINTS"), refuses("TIED", "ties the surfaces; use *TIE"),
                           refuses("SMOOTH", "rounds the master surface, which changes gaps; take it out"),
                           refuses("GEOMETRIC CORRECTION", "rounds the surfaces, which changes gaps; take it out")}};
  rules["TIE"] = {DataLines::needed,
                  2,
                  0,
                  {harmless("NAME"), takes("ADJUST", "YES|NO"), takes("POSITION TOLERANCE"),
                   harmless("TYPE", "NODE TO SURFACE|SURFACE TO SURFACE"), harmless("NO ROTATION"),
                   harmless("NO THICKNESS"), refuses("CYCLIC SYMMETRY", "repeats the model in a circle"),
                   refuses("MULTISTAGE", "repeats the model in a circle"),
                   refuses("TIED NSET", "ties some of the nodes only; give a surface of these")}};
  rules["CONTACTCONTROLS"] = {DataLines::optional,
                              0,
                              0,
                              {refuses("STABILIZE", "adds forces against the motion; take it out"),
                               refuses("FRICTION ONSET", "lets friction begin later; take it out"),
                               refuses("MAXCHP", "allows contact to be violated; take it out"),
                               refuses("PERRMX", "allows contact to be violated; take it out"),
                               refuses("UERRMX", "allows contact to be violated; take it out")},
                              true};
}

void add_history_rules(Rules& rules) {
  const std::string times = "STEP TIME|TOTAL TIME", table = "changes its table; write the values that are meant";
  rules["AMPLITUDE"] = {
      DataLines::needed,
      8,
      0,
      {takes("NAME"), takes("TIME", times), takes("VALUE", "RELATIVE|ABSOLUTE"), takes("DEFINITION"), takes("INPUT"),
       refuses("SHIFTX", table), refuses("SHIFTY", table), refuses("USER", table), refuses("SMOOTH", table)}};
  rules["STEP"] = {DataLines::optional,
                   0,
                   0,
                   {takes("NAME"), takes("AMPLITUDE", "RAMP|STEP"), harmless("INC"), harmless("UNSYMM"),
                    harmless("EXTRAPOLATION"), harmless("CONVERT SDI"), takes("NLGEOM"),
                    refuses("PERTURBATION", "is a step about the state before it, which Scabo does not have")}};
  rules["STATIC"] = {DataLines::optional,
                     4,
                     1,
                     {takes("DIRECT"), harmless("SOLVER"),
                      refuses("RIKS", "follows a path of unknown loads, which Scabo does not have"),
                      refuses("STABILIZE", "adds forces against the motion; take it out, contact holds Scabo's bodies"),
                      refuses("TIME RESET", "sets the time of amplitudes; take it out"),
                      refuses("TOTAL TIME AT START", "sets the time of amplitudes; take it out")}};
  const auto user = refuses("USER", "takes its values from a program of its own; write numbers");
  const auto load_case = refuses("LOAD CASE", "is a case of cyclic symmetry; take it out");
  const auto delay = takes("TIME DELAY");
  const auto submodel = refuses("SUBMODEL", "takes its values from another run; write numbers");
  rules["BOUNDARY"] = {DataLines::needed_unless_new,
                       4,
                       0,
                       {takes("OP", "NEW|MOD"), takes("MOD"), takes("AMPLITUDE"), takes("FIXED"),
                        harmless("TYPE", "DISPLACEMENT"), user, load_case, delay, submodel}};
  rules["CLOAD"] = {DataLines::needed_unless_new,
                    3,
                    0,
                    {takes("OP", "NEW|MOD"), takes("AMPLITUDE"), user, load_case, delay, submodel,
                     refuses("FOLLOWER", "turns the force with the body, and Scabo's displacements are small"),
                     refuses("SECTOR", "is a case of cyclic symmetry; take it out"),
                     refuses("OMEGA0", "is a frequency of a dynamic analysis")}};
  rules["DLOAD"] = {DataLines::needed_unless_new,
                    0,
                    0,
                    {takes("OP", "NEW|MOD"), takes("AMPLITUDE"), user, load_case, delay, submodel,
                     refuses("SECTOR", "is a case of cyclic symmetry; take it out"),
                     refuses("CONSTANT RESULTANT", "keeps a sum as the surface changes; take it out"),
                     refuses("FOLLOWER", "is of a load that turns; take it out"),
                     refuses("ORIENTATION", "gives the load axes of its own; write it along x and y")}};
  rules["DSLOAD"] = rules["DLOAD"];
  rules["DSLOAD"].most_entries = 3;
  rules["INITIALCONDITIONS"] = {DataLines::optional, 0, 0, {}, true};
  rules["RESTART"] = {
      DataLines::optional, 0, 0, {refuses("READ", "goes on from another run, which a deck alone does not tell")}, true};
}

std::string without_blanks(std::string text) {
  std::erase_if(text, [](char c) { return static_cast<unsigned char>(c) <= ' '; });
  return files::upper(text);
}

void check_parameter(const DeckBlock& block, const KeywordRule& rule, const std::string& name, const std::string& value,
                     Remarks& remarks) {
  const auto found = std::find_if(rule.parameters.begin(), rule.parameters.end(), [&](const ParameterRule& known) {
    return without_blanks(known.name) == without_blanks(name);
  });
  if (found == rule.parameters.end()) {
    if (!rule.any_parameter)
      remarks.essential(block.at,
                        fmt::format("{} with {} is not taken: the parameter is not known to the converter, and "
                                    "may change the results",
                                    block.written, files::printable(name)));
    return;
  }
  if (found->use == Use::refused && without_blanks(value) == "NO") return;
  if (found->use == Use::refused)
    return remarks.essential(block.at, fmt::format("{} with {} {}", block.written, found->name, found->why));
  if (found->values.empty()) return;
  for (const std::string& allowed : found->values)
    if (without_blanks(allowed) == without_blanks(value)) return;
  remarks.essential(block.at, fmt::format("{} with {}={} is not taken; there is {}", block.written, found->name,
                                          files::printable(value), fmt::join(found->values, ", ")));
}

bool lacks_data(const DeckBlock& block, DataLines wanted) {
  if (block.has_data || wanted == DataLines::optional) return false;
  if (wanted == DataLines::needed_unless_elset) return !block.parameters.contains("ELSET");
  if (wanted == DataLines::needed_unless_new) return files::upper(parameter(block, "OP")) != "NEW";
  return !(block.name == "FRICTION" && block.parameters.contains("ROUGH"));
}

}  // namespace

const std::map<std::string, KeywordRule>& keyword_rules() {
  static const Rules all = [] {
    Rules rules;
    add_mesh_rules(rules);
    add_material_rules(rules);
    add_contact_rules(rules);
    add_history_rules(rules);
    return rules;
  }();
  return all;
}

const KeywordRule* rule_of(const std::string& name) {
  const auto found = keyword_rules().find(name);
  return found == keyword_rules().end() ? nullptr : &found->second;
}

void check_block(const DeckBlock& block, Remarks& remarks) {
  const KeywordRule* rule = rule_of(block.name);
  if (rule == nullptr) return;
  for (const auto& [name, value] : block.parameters) check_parameter(block, *rule, name, value, remarks);
  if (lacks_data(block, rule->data))
    remarks.essential(block.at, fmt::format("{} has no data lines; add them, or take it out", block.written));
  std::size_t count = 0;
  for (const DeckLine& line : block.lines) {
    if (rule->most_lines > 0 && ++count > rule->most_lines)
      return remarks.essential(line.at, fmt::format("{} takes {} of data, and this is one more; take it out",
                                                    block.written, rule->most_lines == 1 ? "one line" : "two lines"));
    if (rule->most_entries == 0 || line.fields.size() <= rule->most_entries) continue;
    remarks.essential(
        line.at, fmt::format("{} takes {} entries on a line at most, and '{}' is one more; take it out", block.written,
                             rule->most_entries, files::printable(line.fields[rule->most_entries])));
  }
}

}  // namespace scabo::convert
