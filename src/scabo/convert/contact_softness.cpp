#include "scabo/convert/contact_softness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace scabo::convert {

namespace {

constexpr double most_softness = 0.01;  // as the results of both programs differ by their contact stiffness anyway

/// E / L of a body: stress for each metre by which it is compressed.
double stiffness_of(const files::ImportedMesh& mesh, const DeckBodies& bodies, const std::vector<double>& young,
                    int body) {
  double area = 0.0, least = HUGE_VAL;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    if (bodies.body_of_cell[c] != body) continue;
    area += files::area_of(mesh, mesh.cells[c]);
    if (young[c] > 0.0) least = std::min(least, young[c]);
  }
  return least / std::sqrt(area);
}

void tell(double softness, const files::DeckPlace& at, const char* what, const char* then, bool rigid,
          Remarks& remarks) {
  if (softness <= most_softness)
    return remarks.note(at, fmt::format("{} is left out, which the deck needs for its solver: {}", what, then));
  const std::string share =
      fmt::format("{} is so small that it adds {:.2g} % to the displacements of the bodies", what, 100.0 * softness);
  if (rigid) return remarks.note(at, fmt::format("{}; by --rigid-contact it is left out, and {}", share, then));
  remarks.essential(at, fmt::format("{}, and {}; raise it, or give the deck a layer of its own material there; where "
                                    "it is but an aid of the solver, convert with --rigid-contact",
                                    share, then));
}

}  // namespace

std::optional<double> modulus_of(const files::ImportedMesh& mesh, const DeckBodies& bodies,
                                 const std::vector<double>& young, int a, int b, const DeckInteraction& interaction,
                                 Remarks& remarks) {
  // The softer body, whose displacements are the larger ones.
  return modulus_of(std::min(stiffness_of(mesh, bodies, young, a), stiffness_of(mesh, bodies, young, b)), interaction,
                    remarks);
}

std::optional<double> modulus_of(double body, const DeckInteraction& interaction, Remarks& remarks) {
  if (interaction.exponential) {
    constexpr const char* law =
        "PRESSURE-OVERCLOSURE=EXPONENTIAL presses before the surfaces touch, and Scabo's do not";
    if (interaction.rigid)
      remarks.note(interaction.at_stiffness, fmt::format("{}: by --rigid-contact it is left out", law));
    else
      remarks.essential(interaction.at_stiffness,
                        fmt::format("{}; where it is but an aid of the solver, convert with --rigid-contact", law));
  }
  if (!std::isfinite(body)) return {};  // without a material, which is told elsewhere
  const auto softness = [body](double stiffness) { return stiffness > 0.0 ? body / stiffness : HUGE_VAL; };
  std::optional<double> modulus;
  if (interaction.stiffness) {
    const double share = softness(*interaction.stiffness);
    const bool is_bed = interaction.linear && !interaction.rigid && std::isfinite(share) && share > most_softness;
    if (is_bed) {
      modulus = interaction.stiffness;
      remarks.note(interaction.at_stiffness,
                   fmt::format("the stiffness of contact adds {:.2g} % to the displacements of the bodies, and is the "
                               "`modulus` of the contact; where it is but an aid of the solver, convert with "
                               "--rigid-contact",
                               100.0 * share));
    } else {
      tell(share, interaction.at_stiffness, "the stiffness of contact", "Scabo's bodies in contact do not overlap",
           interaction.rigid, remarks);
    }
  }
  if (interaction.stick_stiffness && *interaction.stick_stiffness > 0.0)
    tell(softness(*interaction.stick_stiffness), interaction.at_stick_stiffness, "the stiffness of sticking",
         "Scabo's pairs that stick do not slip", interaction.rigid, remarks);
  return modulus;
}

}  // namespace scabo::convert
