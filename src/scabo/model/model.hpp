// A model as described by the user, checked and resolved: names have become indices, and shapes have become closed
// boundaries of lines and arcs. Plain structs; nothing is meshed or solved here.
//
// Units are those of the user and must be consistent; all examples use SI units (m, N, Pa, kg/m3).
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "scabo/base/error.hpp"
#include "scabo/base/extent.hpp"
#include "scabo/base/types.hpp"
#include "scabo/base/warning.hpp"
#include "scabo/model/bar.hpp"
#include "scabo/model/body.hpp"
#include "scabo/model/contact.hpp"
#include "scabo/model/curve.hpp"
#include "scabo/model/load.hpp"
#include "scabo/model/material.hpp"
#include "scabo/model/output.hpp"
#include "scabo/model/quantity.hpp"
#include "scabo/model/step.hpp"
#include "scabo/model/support.hpp"

namespace scabo::model {

/// Quasi-static, or the natural frequencies and modes of every elastic body.
enum class AnalysisType { static_, modal };

struct Analysis {
  AnalysisType type = AnalysisType::static_;
  int modes = 10;  ///< modal: number of modes, the lowest first, rigid-body modes included
  Plane plane = Plane::stress;
  double thickness = 1.0;   ///< length, > 0; of the bodies that have none of their own: see thickness_of()
  bool per_radian = false;  ///< bodies of revolution: forces are those of one radian, not of the whole circumference

  bool revolved() const { return plane == Plane::revolution; }
  /// Of bodies of revolution, in words.
  const char* forces_of() const { return per_radian ? "one radian" : "the whole circumference"; }
  /// Of bodies of revolution: on which they are turned, in radians.
  double angle() const { return per_radian ? 1.0 : 2.0 * std::numbers::pi; }
};

/// Library that factorises sparse stiffness matrices.
enum class Factorisation { cholmod, mumps };

struct SolverOptions {
  double tolerance = 1e-10;  ///< bound of every scaled figure of the certificate
  int iterations = 50;       ///< Newton iterations in one attempt, at most
  int halvings = 6;          ///< of an increment that does not converge, at most
  bool uniqueness = false;   ///< search for other solutions of every increment
  Factorisation factorisation = Factorisation::cholmod;
};

/// Results of another run, whose end is the start of this one (analysis/state/restart.hpp).
struct Restart {
  std::string directory;
  /// At its end, for the loads and supports of this model; 0 for one that it does not have. The first step starts from
  /// them.
  std::vector<double> load_factors, support_factors;
  /// Of a run that ended with a step in time: its time since the begin of the first one, and the velocity of its
  /// ground.
  struct Motion {
    double time = 0.0;
    std::array<double, 2> ground{};
  };
  std::optional<Motion> motion = {};
  Source source;
};

/// Velocity of a body before the first time step.
struct InitialVelocity {
  int body = -1;
  Vec2 velocity = Vec2::Zero();  ///< of its centroid, length / time
  double rotation = 0.0;         ///< counter-clockwise about the centroid, radians / time
  Source source;
};

struct Model {
  std::string file;  ///< as given to the reader, for messages
  /// What was read from `file`, which is read only once: it may be a pipe. Null: the model was built by code.
  std::shared_ptr<const std::string> text;
  std::vector<std::string> files;  ///< paths of mesh files and images that were read for it
  std::string title;
  Analysis analysis;
  std::vector<Material> materials;
  std::vector<Body> bodies;
  std::vector<Support> supports;
  std::vector<Spring> springs;
  std::vector<Bar> bars;
  std::vector<Load> loads;
  std::vector<Contact> contacts;
  std::vector<Tie> ties;
  std::vector<Curve> curves;
  std::vector<Step> steps;
  std::vector<InitialVelocity> initial;
  std::optional<Restart> restart;
  SolverOptions solver;
  std::vector<Warning> warnings;  ///< about input that has no effect in this analysis, or is named otherwise
  Output output;
  std::optional<QuantityTolerance> tolerance;  ///< meshes are refined until the bar of a number is that small
  std::vector<AddedMass> added_masses;         ///< water that moves with edges, in time and in modes
  std::vector<PointMass> point_masses;
};

inline std::vector<PointMass> point_masses_on(const Model& model, int body) {
  std::vector<PointMass> found;
  for (const PointMass& point : model.point_masses)
    if (point.on->body == body) found.push_back(point);
  return found;
}

/// Length of a body across the plane; not used by bodies of revolution.
inline double thickness_of(const Model& model, int body) {
  return model.bodies[static_cast<std::size_t>(body)].thickness.value_or(model.analysis.thickness);
}
/// Of a contact: the smaller one of its two bodies, as they touch nowhere else.
inline double thickness_between(const Model& model, const Contact& contact) {
  return std::min(thickness_of(model, contact.a.body), thickness_of(model, contact.b.body));
}

/// What stands behind a point of a body, and of a contact.
inline Extent extent_of(const Model& model, int body) {
  return {thickness_of(model, body), model.analysis.revolved(), model.analysis.angle()};
}
inline Extent extent_between(const Model& model, const Contact& contact) {
  return {thickness_between(model, contact), model.analysis.revolved(), model.analysis.angle()};
}

/// Whether some step is one in time.
inline bool is_dynamic(const Model& model) {
  return std::any_of(model.steps.begin(), model.steps.end(), [](const Step& step) { return step.dynamic.has_value(); });
}

/// Whether cracks grow, which they do in the last step.
inline bool has_growth(const Model& model) { return !model.steps.empty() && model.steps.back().growth.has_value(); }

/// Whether every step is one in time.
inline bool is_all_dynamic(const Model& model) {
  return !model.steps.empty() &&
         std::all_of(model.steps.begin(), model.steps.end(), [](const Step& step) { return step.dynamic.has_value(); });
}

/// Whether the ground moves in some step.
inline bool is_shaken(const Model& model) {
  return std::any_of(model.steps.begin(), model.steps.end(), [](const Step& step) {
    return step.dynamic && (step.dynamic->ground[0] >= 0 || step.dynamic->ground[1] >= 0);
  });
}

}  // namespace scabo::model
