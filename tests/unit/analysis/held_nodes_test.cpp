// What supports that meet at a node of a body in space hold there.
#include "scabo/analysis/space/held_nodes.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <set>
#include <tuple>

namespace scabo::analysis {
namespace {

using Eigen::Vector3d;
using Kind = SupportedDirection::Kind;

/// Supports of one body: `named` has a letter for each, upper case if the user named it.
model::SpaceModel supports(const std::string& named) {
  model::SpaceModel model;
  for (const char letter : named) {
    model::SpaceSupport support;
    support.name = letter;
    support.named = std::isupper(letter) != 0;
    support.on.body = 0;
    model.supports.push_back(support);
  }
  return model;
}

SupportedDirection along(const Vector3d& direction, double value = 0.0, Kind kind = Kind::given) {
  return {direction.normalized(), value, kind};
}

struct Meeting {
  explicit Meeting(const std::string& named) : model(supports(named)), held(model, posed) { posed.bodies.resize(1); }
  std::size_t constraints() const { return posed.bodies[0].supports.size(); }

  model::SpaceModel model;
  SolidModel posed;
  HeldNodes held;
};

TEST(HeldNodes, HoldTheSpanOfAllDirections) {
  Meeting three("abc");
  EXPECT_EQ(three.held.hold(0, 4, along({1, 1, 0})), std::nullopt);
  EXPECT_EQ(three.held.hold(1, 4, along({1, -0.5, 0})), std::nullopt);
  EXPECT_EQ(three.held.hold(2, 4, along({0.3, 1, 0})), std::nullopt);  // within their plane
  EXPECT_EQ(three.constraints(), 2u);
  EXPECT_EQ(three.held.hold(2, 4, along({0.3, 1, -1})), std::nullopt);
  ASSERT_EQ(three.constraints(), 3u);
  std::set<int> dofs;
  for (const system::Constraint& held : three.posed.bodies[0].supports) dofs.insert(held.dof);
  EXPECT_EQ(dofs, (std::set<int>{12, 13, 14}));
  EXPECT_TRUE(three.held.resists(0, 4, {0, 0, 1}));
  EXPECT_FALSE(three.held.resists(0, 5, {0, 0, 1}));
}

TEST(HeldNodes, HoldAnAxisInItsOwnSense) {
  Meeting one("a");
  one.held.hold(0, 0, along({0, -1, 0}, 0.5));
  const system::Constraint& held = one.posed.bodies[0].supports.front();
  EXPECT_EQ(held.component, 1);
  EXPECT_EQ(held.value, -0.5);
}

TEST(HeldNodes, FollowOthersOrContradictThem) {
  Meeting three("abc");
  three.held.hold(0, 0, along({1, 0, 0}, 0.01));
  three.held.hold(1, 0, along({0, 1, 0}, 0.02));
  EXPECT_EQ(three.held.hold(2, 0, along({3, 4, 0}, 0.6 * 0.01 + 0.8 * 0.02)), std::nullopt);
  EXPECT_EQ(three.held.hold(2, 0, along({3, 4, 0}, 0.0)), std::optional<std::size_t>(1));  // the largest part
  EXPECT_EQ(three.constraints(), 2u);
  Meeting named("aB");  // which moves with a factor of its own
  named.held.hold(0, 0, along({1, 2, 0}, 0.01));
  EXPECT_EQ(named.held.hold(1, 0, along({1, 2, 0}, 0.01)), std::optional<std::size_t>(0));
  Meeting still("aB");
  still.held.hold(0, 0, along({1, 2, 0}));
  EXPECT_EQ(still.held.hold(1, 0, along({-1, -2, 0})), std::nullopt);
}

TEST(HeldNodes, NormalsOfOneSmoothFaceAreOne) {
  const Vector3d n(0, 0, 1), near(0.05, 0, 1), opposite(0.05, 0, -1);
  for (const auto& [one, other, direction, constraints] :
       {std::tuple(Kind::normal_of_curved_face, Kind::normal_of_curved_face, near, 1u),
        std::tuple(Kind::normal_of_plane, Kind::normal_of_curved_face, near, 1u),
        std::tuple(Kind::normal_of_plane, Kind::normal_of_plane, near, 2u),  // an edge
        std::tuple(Kind::normal_of_curved_face, Kind::given, near, 2u),
        std::tuple(Kind::normal_of_curved_face, Kind::normal_of_curved_face, opposite, 2u)}) {  // the edge of a blade
    Meeting two("ab");
    two.held.hold(0, 0, along(n, 0.0, one));
    two.held.hold(1, 0, along(direction, 0.0, other));
    EXPECT_EQ(two.constraints(), constraints);
  }
}

TEST(HeldNodes, SupportsThatBeginAreHeldPoints) {
  Meeting two("aB");
  two.model.supports[1].stay.added = 2;
  two.held.hold(0, 0, along({1, 1, 0}));
  EXPECT_EQ(two.held.hold(1, 0, along({1, 1, 0})), std::nullopt);  // which holds at all of its times
  EXPECT_EQ(two.held.hold(1, 0, along({1, 0, 1}, 0.3)), std::nullopt);
  EXPECT_EQ(two.constraints(), 1u);
  ASSERT_EQ(two.posed.held_points.size(), 1u);
  EXPECT_EQ(two.posed.held_points[0].held.component, -1);
  EXPECT_EQ(two.posed.held_points[0].held.value, 0.3);
  EXPECT_EQ(two.posed.held_points[0].stay.added, 2);
}

}  // namespace
}  // namespace scabo::analysis
