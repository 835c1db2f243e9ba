// What unstructured grids of VTK have in common, whether their cells are plane or solid: arrays, pieces, sets by the
// values of arrays. Who derives from it says which cells it takes and what becomes of them.
#pragma once

#include <cstdint>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "scabo/files/mesh_builder.hpp"
#include "scabo/files/vtu_data.hpp"

namespace scabo::files {

/// What a VTK cell type becomes.
struct VtuShape {
  enum class Use { cell, facet, node, unused } use = Use::unused;
  CellKind kind = CellKind::triangle3;  ///< of plane cells
  int nodes = 0;                        ///< that the file gives; 0: any count
  int kept_nodes = 0;                   ///< without those inside
};

class VtuReader {
 public:
  virtual ~VtuReader() = default;

 protected:
  /// An array of integers with one value per cell, of all pieces.
  struct CellArray {
    std::string name;
    std::vector<std::int64_t> values;
  };
  /// What bounds cells, or vertices.
  struct SmallCell {
    std::size_t position;
    bool facet;
    std::vector<std::int64_t> nodes;
  };

  VtuReader(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  /// Hands over nodes and cells. Throws InputError.
  void read_pieces();
  /// Hands over the sets of cells of all arrays with few values. The array that tells regions apart, or null.
  const CellArray* find_regions();

  virtual std::optional<VtuShape> shape_of(std::int64_t type, std::size_t nodes) const = 0;
  /// `has VTK's type 12, ...`
  virtual std::string why_not_read(std::int64_t type, std::size_t nodes) const = 0;
  virtual void add_node(std::int64_t number, double x, double y, double z, const FilePlace& at) = 0;
  virtual void add_cell(const VtuShape& shape, std::int64_t number, const std::vector<std::int64_t>& nodes,
                        const FilePlace& at) = 0;
  virtual int cell_set(const std::string& name) = 0;
  virtual void add_cell_to_set(int set, int cell) = 0;

  const std::vector<std::size_t>& cell_positions() const { return cell_position_; }  ///< among all that the file has
  const std::vector<SmallCell>& small_cells() const { return small_; }
  const std::string& file() const { return file_; }

 private:
  [[noreturn]] void fail(const pugi::xml_node& node, const std::string& message) const;
  int line_at(std::size_t offset) const;
  void open();
  void cut_appended();
  void read_piece(const pugi::xml_node& piece);
  void read_cell_data(const pugi::xml_node& piece, std::size_t cells_before, std::size_t cells);
  void add_cells(const pugi::xml_node& cells, const VtuValues& connectivity, const VtuValues& offsets,
                 const VtuValues& types, std::int64_t first_node, std::size_t points);
  VtuValues values(const pugi::xml_node& array, std::size_t most) const;
  pugi::xml_node array_named(const pugi::xml_node& parent, const char* name) const;
  std::size_t count(const pugi::xml_node& piece, const char* attribute) const;

  std::string_view bytes_, xml_, appended_;
  bool has_appended_ = false, appended_base64_ = false;
  std::string file_;
  VtuEncoding encoding_;
  pugi::xml_document document_;
  std::string without_appended_;
  std::int64_t nodes_ = 0;
  std::size_t positions_ = 0;               // cells of all dimensions so far
  std::vector<std::size_t> cell_position_;  // of those handed over
  std::vector<SmallCell> small_;
  std::vector<CellArray> arrays_;
};

}  // namespace scabo::files
