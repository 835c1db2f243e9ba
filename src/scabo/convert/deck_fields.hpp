// Parameters and numbers of the blocks of a deck, with remarks about those that are missing or wrong.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scabo/convert/remark.hpp"
#include "scabo/files/abaqus.hpp"

namespace scabo::convert {

/// Value of a parameter as written.
std::string parameter(const files::DeckBlock& block, const std::string& name, const std::string& otherwise = "");
/// Whether a parameter is there and not NO.
bool is_on(const files::DeckBlock& block, const std::string& parameter);

/// `what` in a field of a line, `otherwise` if it is empty. Nothing, with a remark, if it is missing or no number.
std::optional<double> number(Remarks& remarks, const files::DeckLine& line, std::size_t field, const char* what,
                             std::optional<double> otherwise = std::nullopt);
/// All numbers of a block. Nothing, with a remark, if they are not as many as those of one temperature.
std::optional<std::vector<double>> numbers_of(Remarks& remarks, const files::DeckBlock& block, std::size_t count,
                                              const char* what);

/// Components that XSYMM, ENCASTRE and so on hold, 0 for x; nothing for another word. In two dimensions z is held as
/// it is.
std::optional<std::vector<int>> components_of(const std::string& word, int dimension);

/// Acceleration of a line of GRAV. Nothing, with a remark, without a direction, and in two dimensions if it is not in
/// the plane.
std::optional<Eigen::Vector3d> gravity_of(Remarks& remarks, const files::DeckLine& line, int dimension);
/// Square of the angular velocity of a line of CENTRIF about the axis of revolution. Nothing, with a remark, if it is
/// about another axis.
std::optional<double> rotation_of(Remarks& remarks, const files::DeckLine& line);

}  // namespace scabo::convert
