#include "scabo/files/abaqus_element.hpp"

#include <string_view>

namespace scabo::files {

std::optional<AbaqusElement> abaqus_element(const std::string& type) {
  for (const char* line : {"T2D", "T3D"}) {
    if (type.rfind(line, 0) == 0) {
      if (type.substr(3, 1) == "2") return AbaqusElement{ElementFamily::line, 2};
      if (type.substr(3, 1) == "3") return AbaqusElement{ElementFamily::line, 3};
      return std::nullopt;
    }
  }
  for (const char* beam : {"B2", "B3"}) {
    if (type.rfind(beam, 0) == 0) {
      if (type.substr(2, 1) == "1") return AbaqusElement{ElementFamily::line, 2};
      if (type.substr(2, 1) == "2") return AbaqusElement{ElementFamily::line, 3};
      return std::nullopt;
    }
  }
  for (const std::string prefix : {"CPS", "CPE", "CAX", "M3D", "STRI", "S"}) {
    if (type.rfind(prefix, 0) != 0) continue;
    const std::string rest = type.substr(prefix.size());
    if (rest.empty()) return std::nullopt;
    const ElementFamily family = prefix[0] == 'C' ? ElementFamily::cell : ElementFamily::shell;
    if (rest == "65" && prefix == "STRI") return AbaqusElement{family, 6};
    const int nodes = rest[0] - '0';
    const std::string options = rest.substr(1);  // R, I, H, M, T, ...; R5 of shells
    const bool known = options.find_first_of("0123456789") == std::string::npos || options == "R5";
    if (!known || (nodes != 3 && nodes != 4 && nodes != 6 && nodes != 8 && nodes != 9)) return std::nullopt;
    return AbaqusElement{family, nodes};
  }
  return std::nullopt;
}

CellKind abaqus_cell_kind(int nodes) {
  switch (nodes) {
    case 3:
      return CellKind::triangle3;
    case 4:
      return CellKind::quad4;
    case 6:
      return CellKind::triangle6;
    default:
      return CellKind::quad8;  // 9: without its centre node
  }
}

bool is_discrete_abaqus_element(const std::string& type) {
  for (const char* start : {"SPRING", "DASHPOT", "GAP", "MASS", "DCOUP"}) {
    if (type.rfind(start, 0) == 0) return true;
  }
  return false;
}

std::string abaqus_refusal(const std::string& type) {
  const auto starts = [&type](std::string_view with) { return type.rfind(with, 0) == 0; };
  if (starts("C3D") || starts("SC") || starts("F3D") || starts("DC3D") || starts("AC3D")) {
    return "is three-dimensional: a model of solids needs 'analysis: {space: true}', one of the plane a mesh of CPS or "
           "CPE elements";
  }
  if (starts("CAXA") || starts("CGAX")) {
    return "turns about the axis or varies around it, which Scabo's bodies of revolution do not: use CAX elements";
  }
  if (starts("SAX") || starts("DCAX") || starts("MAX")) {
    return "is an axisymmetric shell, membrane or thermal element: use CAX elements";
  }
  return "is not read; use elements of a section with 3, 4, 6 or 8 nodes (CPS, CPE, CAX, S, M3D) and take others out "
         "of "
         "the file";
}

}  // namespace scabo::files
