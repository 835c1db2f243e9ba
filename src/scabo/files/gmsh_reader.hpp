// What files of Gmsh have in common, whether their cells are plane or solid: sections, numbers as text or binary, names
// of physical groups. Who derives from it says which elements it takes and what becomes of them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scabo/files/mesh_builder.hpp"
#include "scabo/files/text_cursor.hpp"

namespace scabo::files {

struct GmshElement {
  int type;
  int dimension;
  int nodes;  ///< 0: the file says how many, of a polygon
};

class GmshReader {
 public:
  virtual ~GmshReader() = default;

 protected:
  using Tags = std::vector<std::int64_t>;

  /// `dimension`: of the cells.
  GmshReader(std::string_view bytes, const std::string& file, int dimension)
      : in_(bytes, file), dimension_(dimension) {}

  /// Hands over all nodes and elements. Throws InputError.
  void read_sections();

  virtual void reserve(std::size_t nodes, std::size_t cells) = 0;  ///< about so many will come
  virtual void add_node(std::int64_t number, double x, double y, double z, const FilePlace& at) = 0;
  /// What is known of a type. Fails for one that is not read.
  virtual const GmshElement& element(std::int64_t type, std::int64_t number) = 0;
  /// `may_be_repeated`: for each of its groups.
  virtual void add_element(const GmshElement& element, std::int64_t number, const Tags& groups, std::int64_t entity,
                           const Tags& nodes, const FilePlace& at, bool may_be_repeated) = 0;

  [[noreturn]] void fail(const std::string& message) const;
  bool is_text_of_version_2() const { return version_ == 2 && !binary_; }
  /// `prefix`_7 without a name.
  std::string group_name(int dimension, std::int64_t tag, const char* prefix) const;
  /// Gmsh writes the tag of a group with a minus sign where an entity has the other orientation.
  static std::int64_t magnitude(std::int64_t tag);

 private:
  void read_format();
  void read_names();
  void read_name();
  void read_entities();
  void read_nodes_2();
  void read_elements_2();
  void read_nodes_4();
  void read_elements_4();
  void skip_section(std::string_view name);
  void end_section(std::string_view name, int count_line);

  void need(std::size_t bytes, const char* what) const;
  template <class T>
  T raw(const char* what);

  /// The next number, whether text or binary. In binary files counts and tags of nodes and elements have 8 bytes.
  std::int64_t integer(const char* what) { return binary_ ? raw<std::int32_t>(what) : in_.integer(what); }
  std::int64_t size(const char* what) {
    return binary_ ? static_cast<std::int64_t>(raw<std::uint64_t>(what)) : in_.integer(what);
  }
  double real(const char* what) { return binary_ ? raw<double>(what) : in_.number(what); }
  std::int64_t count(std::int64_t value, const char* what) const;
  std::size_t bounded(std::int64_t count, std::size_t bytes_each) const {
    return std::min<std::size_t>(static_cast<std::size_t>(count), in_.remaining() / bytes_each);
  }
  void start_binary_data();
  FilePlace place() const { return {0, binary_ ? 0 : in_.line()}; }

  TextCursor in_;
  int dimension_;
  bool binary_ = false;
  int version_ = 0;                                            // 2 or 4
  std::map<std::pair<int, std::int64_t>, std::string> names_;  // by dimension, or no_dimension, and tag
  std::map<std::pair<int, std::int64_t>, Tags> groups_of_;     // version 4: by dimension and entity
  bool has_nodes_ = false, has_elements_ = false;
};

}  // namespace scabo::files
