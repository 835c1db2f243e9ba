#include "scabo/convert/keywords.hpp"

#include <string>

namespace scabo::convert {

namespace {

struct Group {
  KeywordLoss loss;
  const char* text;
  const char* names;  // with a space between them
};

constexpr Group groups[] = {
    {KeywordLoss::none, "",
     "PART ENDPART ASSEMBLY ENDASSEMBLY ENDINSTANCE ENDSTEP PREPRINT HEADING NODE ELEMENT NSET ELSET SURFACE "
     "INSTANCE CHANGEFRICTION"},
    {KeywordLoss::note, "requests output and is left out; Scabo's results have files of their own",
     "NODEFILE ELFILE NODEPRINT ELPRINT OUTPUT NODEOUTPUT ELEMENTOUTPUT CONTACTFILE CONTACTPRINT CONTACTOUTPUT "
     "RESTART MONITOR PRINT SECTIONPRINT FACEPRINT SECTIONFILE FILEFORMAT ENERGYOUTPUT ENERGYPRINT ENERGYFILE "
     "TIMEPOINTS FILTER FILEOUTPUT DIAGNOSTICS"},
    {KeywordLoss::note, "controls a solver and is left out; Scabo's needs no parameters",
     "CONTROLS CONTACTCONTROLS SECTIONCONTROLS SOLVERCONTROLS"},
    {KeywordLoss::note, "has no effect in a static analysis and is left out",
     "DAMPING CONDUCTIVITY SPECIFICHEAT GAPCONDUCTANCE GAPHEATGENERATION PHYSICALCONSTANTS"},
    {KeywordLoss::essential, "adds forces against the motion of the surfaces, which Scabo does not have; take it out",
     "CONTACTDAMPING"},
    {KeywordLoss::essential, "gives an initial state, which is not taken; a `field` load of a model may replace it",
     "INITIALCONDITIONS"},
    {KeywordLoss::essential, "is plasticity, which Scabo does not have: the body would stay elastic",
     "PLASTIC CYCLICHARDENING DEFORMATIONPLASTICITY MOHRCOULOMB MOHRCOULOMBHARDENING DRUCKERPRAGER "
     "DRUCKERPRAGERHARDENING CAPPLASTICITY CONCRETE CONCRETEDAMAGEDPLASTICITY RATEDEPENDENT"},
    {KeywordLoss::essential, "is a law that Scabo does not have; its materials are linear elastic",
     "HYPERELASTIC HYPERFOAM CREEP VISCOELASTIC USERMATERIAL NOCOMPRESSION DEPVAR COMPRESSIONONLY NOTENSION "
     "FAILSTRESS DAMAGEINITIATION DAMAGEEVOLUTION SUPERELASTIC VALUESATINFINITY"},
    {KeywordLoss::essential,
     "joins degrees of freedom, which Scabo's models cannot; use *TIE where faces stay together, and for a face of "
     "solids "
     "that moves as one piece *COUPLING",
     "EQUATION MPC RIGIDBODY COUPLING KINEMATIC DISTRIBUTING DISTRIBUTINGCOUPLING NETWORKMPC EMBEDDEDELEMENT "
     "CYCLICSYMMETRYMODEL"},
    {KeywordLoss::essential, "tightens a bolt, and is not converted; a body of a model in space may have a `preload`",
     "PRE-TENSIONSECTION PRETENSIONSECTION"},
    {KeywordLoss::essential, "makes elements without area, which are not taken; `springs` of a model may replace them",
     "SPRING DASHPOT GAP MASS CONNECTORSECTION ROTARYINERTIA"},
    {KeywordLoss::essential, "gives local axes of nodes, which are not taken; write supports and forces along x and y",
     "TRANSFORM"},
    {KeywordLoss::essential, "is not taken; a `temperature` load of a model may replace it", "TEMPERATURE"},
    {KeywordLoss::essential, "is no static analysis; Scabo converts *STATIC steps",
     "DYNAMIC FREQUENCY BUCKLE HEATTRANSFER VISCO COUPLEDTEMPERATURE-DISPLACEMENT UNCOUPLEDTEMPERATURE-DISPLACEMENT "
     "STEADYSTATEDYNAMICS MODALDYNAMIC COMPLEXFREQUENCY GREEN GEOSTATIC SOILS RESPONSESPECTRUM SENSITIVITY "
     "ELECTROMAGNETICS"},
    {KeywordLoss::essential, "changes the contact or the elements within the analysis, which Scabo's models cannot",
     "MODELCHANGE CHANGESURFACEBEHAVIOR CHANGECONTACTTYPE"},
    {KeywordLoss::essential, "is general contact, which is not taken; name the surfaces with *CONTACT PAIR",
     "CONTACT CONTACTINCLUSIONS CONTACTEXCLUSIONS CONTACTPROPERTYASSIGNMENT"},
    {KeywordLoss::essential, "sets gaps by a value, which is not taken; `gap` of a contact may replace it",
     "CLEARANCE CONTACTINTERFERENCE"},
};

bool contains(const std::string& names, const std::string& name) {
  return (' ' + names + ' ').find(' ' + name + ' ') != std::string::npos;
}

}  // namespace

KeywordText text_of_keyword(const std::string& name) {
  for (const Group& group : groups)
    if (contains(group.names, name)) return {group.loss, group.text};
  return {KeywordLoss::essential, "is not known to the converter, and what it says is missing in the model"};
}

bool is_of_material(const std::string& name) {
  if (contains("DAMPING CONDUCTIVITY SPECIFICHEAT", name)) return true;
  const KeywordText text = text_of_keyword(name);
  return text.text.find("law that") != std::string::npos || text.text.find("plasticity") != std::string::npos;
}

}  // namespace scabo::convert
