#include "scabo/analysis/space/solid_mechanism.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "scabo/analysis/space/large_motions.hpp"
#include "scabo/analysis/space/prepared_solids.hpp"
#include "scabo/base/error.hpp"
#include "scabo/contact/questions/onset.hpp"
#include "scabo/linalg/decompositions.hpp"
#include "scabo/system/solid_part.hpp"

namespace scabo::analysis {

namespace {

constexpr double least_motion = 1e-6;  // of the largest: motions are found to about 1e-8

/// Of the nodes of body `b`, from amplitudes of the contact problem.
Vector displacement_of_body(const MovingSolids& solids, std::size_t b, const Vector& motion) {
  const Matrix rigid = solids.rigid_motions(b);
  return rigid * motion.segment(solids.contact.first_rigid[b], rigid.cols());
}

/// Without parts that are rounding beside `largest`.
Eigen::Vector3d rounded(Eigen::Vector3d vector, double largest) {
  for (double& component : vector)
    if (std::abs(component) <= least_motion * largest) component = 0.0;
  return vector;
}

std::string text_of(const Eigen::Vector3d& vector) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", vector.x(), vector.y(), vector.z());
}

std::string direction(const Eigen::Vector3d& vector) { return text_of(rounded(vector.normalized(), 1.0)); }

/// A direction whose first component that is not rounding is positive: of motions both ways.
std::string line(const Eigen::Vector3d& vector) {
  const Eigen::Vector3d along = rounded(vector.normalized(), 1.0);
  for (const double component : along)
    if (component != 0.0) return direction(component < 0.0 ? Eigen::Vector3d(-along) : along);
  return direction(along);
}

const std::string& name_of(const SolidModel& model, int body) {
  return model.bodies[static_cast<std::size_t>(body)].name;
}

/// Motions that move most first; equal ones, within rounding, in the order of the model.
std::vector<std::size_t> moving_bodies(const SolidMechanism& mechanism) {
  std::vector<std::size_t> moving;
  for (std::size_t b = 0; b < mechanism.bodies.size(); ++b)
    if (mechanism.bodies[b].moves()) moving.push_back(b);
  std::stable_sort(moving.begin(), moving.end(), [&](std::size_t a, std::size_t b) {
    return std::lround(1e4 * mechanism.bodies[a].largest) > std::lround(1e4 * mechanism.bodies[b].largest);
  });
  return moving;
}

/// From the amplitudes of a motion, not all zero, whose largest displacement is made 1.
SolidMechanism mechanism_of(const MovingSolids& solids, const Vector& motion) {
  SolidMechanism mechanism;
  const auto shortenings = motion.tail(static_cast<Eigen::Index>(solids.tightened.size()));
  double largest = shortenings.size() > 0 ? shortenings.lpNorm<Eigen::Infinity>() : 0.0;
  std::vector<Vector> u;
  for (std::size_t b = 0; b < solids.model.bodies.size(); ++b) {
    u.push_back(displacement_of_body(solids, b, motion));
    mechanism.bodies.push_back(motion_of_nodes(solids.model.bodies[b].mesh, u.back()));
    largest = std::max(largest, mechanism.bodies.back().largest);
  }
  ensure(largest > 0.0 && std::isfinite(largest), "a mechanism moves a body or a bolt");
  for (SolidBodyMotion& body : mechanism.bodies) {
    body.shift /= largest;
    body.rotation /= largest;
    body.largest /= largest;
  }
  for (std::size_t k = 0; k < solids.tightened.size(); ++k)
    if (std::abs(shortenings[static_cast<Eigen::Index>(k)]) > 1e-4 * largest)
      mechanism.bolts.push_back(solids.model.preloads[solids.tightened[k]].body);
  mechanism.motion = motion / largest;
  return mechanism;
}

/// M^-1 as if all bodies were of one material: volume, and moments of inertia.
Eigen::SparseMatrix<double> inverse_mass_of_solids(const MovingSolids& solids) {
  std::vector<Eigen::Triplet<double>> entries;
  double scale = 0.0;  // a power of two, of the first body
  const auto scaled = [&](double volume) {
    if (scale == 0.0) scale = std::exp2(-std::ilogb(volume));
    return scale * volume;
  };
  for (std::size_t b = 0; b < solids.model.bodies.size(); ++b) {
    const Matrix rigid = solids.rigid_motions(b);
    if (rigid.cols() == 0) continue;
    const Vector weights = system::volume_of(solids.model.bodies[b].mesh).weights;
    const double unit = scaled(weights.sum()) / weights.sum();
    const Vector of_rows = unit * weights.replicate(1, 3).transpose().reshaped();
    const Matrix inverse = Matrix(rigid.transpose() * of_rows.asDiagonal() * rigid).inverse();
    const Eigen::Index first = solids.contact.first_rigid[b];
    for (Eigen::Index i = 0; i < rigid.cols(); ++i)
      for (Eigen::Index j = 0; j < rigid.cols(); ++j)
        entries.emplace_back(first + i, first + j, 0.5 * (inverse(i, j) + inverse(j, i)));
  }
  const Eigen::Index motions = solids.contact.rigid_motions(),
                     all = motions + static_cast<Eigen::Index>(solids.tightened.size());
  for (std::size_t k = 0; k < solids.tightened.size(); ++k) {
    const auto body = static_cast<std::size_t>(solids.model.preloads[solids.tightened[k]].body);
    const Eigen::Index place = motions + static_cast<Eigen::Index>(k);
    entries.emplace_back(place, place, 1.0 / scaled(system::volume_of(solids.model.bodies[body].mesh).volume));
  }
  Eigen::SparseMatrix<double> result(all, all);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

/// `u`: of the pairs that move.
std::vector<SolidPair> moved_pairs(const MovingSolids& solids, const Vector& u) {
  std::vector<SolidPair> pairs = solids.pairs;
  for (std::size_t k = 0; k < solids.contact.pairs.size(); ++k) {
    if (solids.contact.pairs[k].is_bar()) continue;
    const auto i = static_cast<std::size_t>(solids.contact.pairs[k].index);
    const Eigen::Vector3d of_pair = u.segment<3>(3 * static_cast<Eigen::Index>(k));
    pairs[i].gap = of_pair[0];
    pairs[i].slip = (solids.turned[i] ? -1.0 : 1.0) * slip_of_pair(solids.points[i].directions, of_pair.tail<2>());
  }
  if (solids.absent.empty()) return pairs;
  std::vector<SolidPair> there;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (!solids.is_absent(solids.points[i].a.part) && !solids.is_absent(solids.points[i].b.part))
      there.push_back(pairs[i]);
  return there;
}

}  // namespace

SolidBodyMotion motion_of_nodes(const mesh::SolidMesh& mesh, const Vector& u) {
  const system::SolidVolume volume = system::volume_of(mesh);
  SolidBodyMotion motion;
  motion.about = volume.centroid;
  const Vector weights = volume.weights / volume.weights.sum();
  const Eigen::Map<const Eigen::Matrix3Xd> moved(u.data(), 3, mesh.nodes.cols());
  motion.shift = moved * weights;
  Eigen::Vector3d turning = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i) {
    const Eigen::Vector3d arm = mesh.nodes.col(i) - motion.about;
    turning += weights[i] * arm.cross(moved.col(i) - motion.shift);
    inertia += weights[i] * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
    motion.largest = std::max(motion.largest, moved.col(i).norm());
    motion.size = std::max(motion.size, arm.norm());
  }
  motion.rotation = inertia.ldlt().solve(turning);
  return motion;
}

std::optional<Eigen::Vector3d> SolidBodyMotion::axis() const {
  if (rotation.norm() * size <= least_motion * largest) return std::nullopt;
  return Eigen::Vector3d(about + rotation.cross(shift) / rotation.squaredNorm());
}

SolidMechanism solid_mechanism(const MovingSolids& solids, const contact::Problem& problem,
                               const contact::Solution& solution) {
  const std::optional<Vector> onset = contact::onset_of_motion(problem, inverse_mass_of_solids(solids));
  SolidMechanism mechanism = mechanism_of(solids, onset ? *onset : solution.motion);
  mechanism.rule = onset ? FlowRule::coulomb : FlowRule::associated;
  mechanism.work = problem.f.dot(mechanism.motion);
  mechanism.pairs = moved_pairs(solids, problem.G * mechanism.motion);
  mechanism.absent = solids.absent;
  return mechanism;
}

std::string describe_motion(const SolidBodyMotion& motion) {
  const std::optional<Eigen::Vector3d> axis = motion.axis();
  if (!axis) return fmt::format("translation along {}", direction(motion.shift));
  std::string text = fmt::format("rotation about the axis through {} along {}", text_of(rounded(*axis, motion.size)),
                                 direction(motion.rotation));
  if (std::abs(motion.shift.dot(motion.rotation.normalized())) > least_motion * motion.largest)
    text += " and translation along it";
  return text;
}

std::string describe(const SolidMechanism& mechanism, const SolidModel& model) {
  const std::vector<std::size_t> moving = moving_bodies(mechanism);
  if (moving.empty()) return fmt::format("bolt '{}' is shortened", name_of(model, mechanism.bolts.front()));
  return fmt::format("{} of {} bodies {} '{}'", moving.size(), mechanism.present(),
                     moving.size() == 1 ? "moves," : "move, most of all", model.bodies[moving.front()].name);
}

namespace {

/// `body 'block': translation along (1, 0, 0); body 'lid': ...`, those that move most first.
std::string describe_motions(const SolidMechanism& mechanism, const SolidModel& model) {
  constexpr std::size_t most = 4;
  const std::vector<std::size_t> moving = moving_bodies(mechanism);
  std::string text;
  for (std::size_t i = 0; i < std::min(moving.size(), most); ++i)
    text += fmt::format("{}body '{}': {}", i > 0 ? "; " : "", model.bodies[moving[i]].name,
                        describe_motion(mechanism.bodies[moving[i]]));
  if (moving.size() > most)
    text += fmt::format("; and {} more {}", moving.size() - most, moving.size() - most == 1 ? "body" : "bodies");
  for (const int bolt : mechanism.bolts)
    text += fmt::format("{}bolt '{}' is shortened", text.empty() ? "" : "; ", name_of(model, bolt));
  return text;
}

}  // namespace

std::string reason_of_solids(const SolidModel& model, const contact::Solution& solution,
                             const std::optional<SolidMechanism>& mechanism) {
  if (!mechanism) return solution.reason;
  const std::string motions = describe_motions(*mechanism, model);
  if (solution.status == contact::Status::mechanism)
    return fmt::format("mechanism: {}, held neither by supports nor by contact and friction", motions);
  return fmt::format("collapse: no equilibrium was found, and the bodies begin to move when they are let go ({})",
                     motions);
}

namespace {

/// Columns: an orthonormal basis of the span of those of A, directions below `least` of the largest left out.
Matrix span_of(const Matrix& A, double least) {
  const Eigen::JacobiSVD<Matrix> svd(A, Eigen::ComputeThinU);
  Eigen::Index rank = 0;
  while (rank < svd.singularValues().size() && svd.singularValues()[rank] > least) ++rank;
  return svd.matrixU().leftCols(rank);
}

/// `any translation`, `translations normal to (0, 0, 1)`, `translation along (1, 0, 0)`; of 1 to 3 columns.
std::string dimensions_of(const Matrix& directions, const char* one, const char* many) {
  const Eigen::Matrix3d projector = directions * directions.transpose();
  if (directions.cols() == 3) return fmt::format("any {}", one);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(projector);  // smallest first
  if (directions.cols() == 2) return fmt::format("{} normal to {}", many, line(eigen.eigenvectors().col(0)));
  return fmt::format("{} along {}", one, line(eigen.eigenvectors().col(2)));
}

/// How a body may move; columns of `U`: displacements of its nodes. `least`: what is rounding. Empty: it does not.
std::string ways_of_body(const mesh::SolidMesh& mesh, const Matrix& U, double least) {
  Matrix ways(6, U.cols());  // shift and rotation times size
  SolidBodyMotion one;
  for (Eigen::Index k = 0; k < U.cols(); ++k) {
    one = motion_of_nodes(mesh, U.col(k));
    ways.col(k) << one.shift, one.size * one.rotation;
  }
  const Matrix Q = span_of(ways, least);
  if (Q.cols() == 0) return {};
  if (Q.cols() == 6) return "any motion";
  if (Q.cols() == 1) {
    one.shift = Q.col(0).head<3>();
    one.rotation = Q.col(0).tail<3>() / one.size;
    one.largest = 1.0;
    return describe_motion(one);
  }
  const Eigen::JacobiSVD<Matrix> turning(Q.bottomRows(3), Eigen::ComputeThinU | Eigen::ComputeFullV);
  Eigen::Index turns = 0;
  while (turns < turning.singularValues().size() && turning.singularValues()[turns] > least_motion) ++turns;
  const Matrix still = Q.topRows(3) * turning.matrixV().rightCols(Q.cols() - turns);
  std::string text;
  if (still.cols() > 0) text = dimensions_of(span_of(still, least_motion), "translation", "translations");
  if (turns == 0) return text;
  return (text.empty() ? "" : text + " and ") +
         dimensions_of(turning.matrixU().leftCols(turns), "rotation about an axis", "rotations about axes");
}

/// Its subject are the bodies. Nothing if they have no part in it.
std::optional<Warning> undetermined_motion_warning(const MovingSolids& solids, const Matrix& undetermined) {
  if (undetermined.cols() == 0) return std::nullopt;
  std::vector<Matrix> of_bodies;
  double largest = 0.0;
  for (std::size_t b = 0; b < solids.model.bodies.size(); ++b) {
    const Matrix rigid = solids.rigid_motions(b);
    of_bodies.push_back(rigid * undetermined.middleRows(solids.contact.first_rigid[b], rigid.cols()));
    if (rigid.cols() > 0) largest = std::max(largest, of_bodies.back().lpNorm<Eigen::Infinity>());
  }
  std::string subject, text;
  for (std::size_t b = 0; b < of_bodies.size() && largest > 0.0; ++b) {
    const std::string ways =
        of_bodies[b].size() > 0 ? ways_of_body(solids.model.bodies[b].mesh, of_bodies[b], least_motion * largest) : "";
    if (ways.empty()) continue;
    subject += fmt::format("{}'{}'", subject.empty() ? "" : ", ", solids.model.bodies[b].name);
    text += fmt::format("{}body '{}': {}", text.empty() ? "" : "; ", solids.model.bodies[b].name, ways);
  }
  if (text.empty()) return std::nullopt;
  return Warning{WarningKind::undetermined_motion, subject,
                 fmt::format("supports, friction and loads do not determine {}; the smallest such motion was chosen: "
                             "add a support if the position matters",
                             text)};
}

/// Of displacements and rotations that are not small.
std::optional<Warning> large_motion_warning(const SolidModel& model, const std::vector<Vector>& u) {
  std::vector<SolidMotion> motions;
  std::vector<bool> rigid;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    motions.push_back(motion_of(model.bodies[b].mesh, u[b]));
    rigid.push_back(model.bodies[b].rigid_at.has_value());
  }
  const std::optional<LargeMotion> large = large_motion_of(motions, rigid);
  if (!large) return std::nullopt;
  return Warning{WarningKind::large_displacement, "",
                 large->text(model.bodies[static_cast<std::size_t>(large->body)].name)};
}

/// Of pairs of bodies whose pressure is beyond small strains.
void add_pressures(const SolidModel& model, SolidIncrement& to) {
  constexpr double most = 0.05;  // of Young's modulus: a strain
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const SolidBody& a = model.bodies[static_cast<std::size_t>(model.contacts[c].a.body)];
    const SolidBody& b = model.bodies[static_cast<std::size_t>(model.contacts[c].b.body)];
    double pressure = 0.0, stiffness = HUGE_VAL;
    for (const SolidPair& pair : to.pairs)
      if (pair.contact == static_cast<int>(c)) pressure = std::max(pressure, pair.normal_force() / pair.area);
    for (const SolidBody* body : {&a, &b})
      if (!body->rigid_at) stiffness = std::min(stiffness, body->young);
    if (pressure > most * stiffness)
      to.warnings.push_back({WarningKind::pressure, fmt::format("'{}', '{}'", a.name, b.name),
                             fmt::format("between bodies '{}' and '{}' the pressure reaches {:.3g}, {:.3g} % of "
                                         "Young's modulus: small strains are assumed",
                                         a.name, b.name, pressure, 100.0 * pressure / stiffness)});
  }
}

}  // namespace

void add_warnings(const MovingSolids& solids, const contact::Solution& solution, std::vector<Warning>& given,
                  SolidIncrement& to) {
  if (auto motions = undetermined_motion_warning(solids, solution.undetermined))
    to.warnings.push_back(*std::move(motions));
  if (to.uniqueness && to.uniqueness->others > 0)
    to.warnings.push_back({WarningKind::several_solutions, "",
                           fmt::format("other solutions exist ({} found); the one closest to the previous increment "
                                       "was chosen: see 'uniqueness' in summary.json",
                                       to.uniqueness->others)});
  add_pressures(solids.model, to);
  if (auto large = large_motion_warning(solids.model, to.u)) to.warnings.push_back(*std::move(large));
  const auto is_told = [&](const Warning& warning) {
    return std::any_of(given.begin(), given.end(), [&](const Warning& other) {
      return warning.kind == other.kind && warning.subject == other.subject;
    });
  };
  to.warnings.erase(std::remove_if(to.warnings.begin(), to.warnings.end(), is_told), to.warnings.end());
  given.insert(given.end(), to.warnings.begin(), to.warnings.end());
}

}  // namespace scabo::analysis
