// Reads an input file of Abaqus or CalculiX: keyword by keyword first (abaqus_reader, abaqus_reader_sets), then, with
// all nodes and elements known, regions, sets and surfaces (abaqus_reader_end).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scabo/files/abaqus.hpp"
#include "scabo/files/abaqus_instances.hpp"
#include "scabo/files/abaqus_lines.hpp"
#include "scabo/files/abaqus_sets.hpp"
#include "scabo/files/mesh_builder.hpp"

namespace scabo::files {

class AbaqusReader {
 public:
  AbaqusReader(std::string_view text, const std::string& file, const ReadInclude& read_include)
      : builder_(file),
        lines_(text, file, read_include, builder_),
        most_entries_(1'000'000 + 20 * static_cast<std::int64_t>(text.size())) {}

  ImportedMesh read();
  AbaqusDeck read_deck();
  /// Of the cells, each once, as they are written in upper case.
  const std::vector<std::string>& types() const { return types_; }

 private:
  /// A number that a set names; those of GENERATE need not exist.
  struct Listed {
    std::int64_t number;
    FilePlace at;
    bool node;
  };
  struct SurfaceEntry {
    std::string of;  // element or set
    std::string side;
    int instance;  // that the entry is of, if it does not name one
    FilePlace at;
  };
  struct Surface {
    std::string name;
    std::string written;  // in messages: surface 'Top', or the keyword whose line names sides
    std::vector<SurfaceEntry> entries;
  };
  struct Section {
    std::string keyword, set, material;
    FilePlace at;
  };
  struct LineElement {
    std::int64_t number;
    std::array<std::int64_t, 3> nodes;  // start, end, middle or -1
  };
  struct Part {
    std::string name;
    RecordedLines lines;
  };

  void read_keywords();
  void keyword(const AbaqusKeyword& key);
  void nodes(const AbaqusKeyword& key);
  void elements(const AbaqusKeyword& key);
  void nodes_of_element(std::vector<std::string_view>& fields, std::size_t wanted, std::int64_t number,
                        const std::string& type, std::vector<std::int64_t>& nodes);
  void set(const AbaqusKeyword& key, AbaqusSets& sets, const char* parameter);
  void nodes_of_elements(const AbaqusKeyword& key, AbaqusSet& target, int instance);
  void generate(AbaqusSet& target, int instance);
  void surface(const AbaqusKeyword& key);
  void section(const AbaqusKeyword& key);
  void part(const AbaqusKeyword& key);
  void instance(const AbaqusKeyword& key);
  Placement placement();
  void end_instance(const AbaqusKeyword& key);
  void read_lone_part();
  void block(const AbaqusKeyword& key);
  DeckLine deck_line(const AbaqusKeyword& key, const std::vector<std::string_view>& fields);
  bool next_data(std::vector<std::string_view>& fields);
  DeckPlace place_of(const FilePlace& at) const { return {builder_.file(at), at.line}; }

  std::int64_t integer(std::string_view field, const char* what) const;
  double real(std::string_view field, const char* what) const;
  /// A number of this line in the present instance.
  std::int64_t own(std::int64_t number, int instance) const;
  std::int64_t own(std::string_view field, const char* what) const { return own(integer(field, what), instance_); }
  /// `5` or `Block-1.5`; nothing if it is a name.
  std::optional<std::int64_t> number_in(const std::string& field, int instance) const;
  const AbaqusSet* set_in(const AbaqusSets& sets, const std::string& name, int instance) const;
  std::string full_name(const std::string& name) const { return instances_.full_name(instance_, name); }
  int instance_named(const AbaqusKeyword& key) const;

  void add_numbers(AbaqusSet& target, const std::vector<std::int64_t>& numbers);
  void add_listed(AbaqusSet& target, std::int64_t number, bool node);
  void count_entries(std::int64_t count);

  // `elements` gives positions: cells first, then lines.
  void resolve_regions(const NumberIndex& elements);
  void resolve_sets(const NumberIndex& elements);
  void resolve_surfaces(const NumberIndex& elements);
  void resolve_entry(int set, const Surface& surface, const SurfaceEntry& entry, const NumberIndex& elements);
  void tell_what_is_not_there(const NumberIndex& elements);
  void set_of_each_instance();
  void name_small(ImportedMesh& mesh);
  void number_small(ImportedMesh& mesh);

  MeshBuilder builder_;
  AbaqusLines lines_;
  std::int64_t most_entries_;  // of all sets together: sets of sets grow faster than the file
  std::int64_t entries_ = 0;
  std::vector<std::int64_t> cell_numbers_;
  std::vector<bool> shell_;  // per cell
  std::vector<std::string> types_;
  std::vector<LineElement> line_elements_;
  std::vector<std::int64_t> discrete_;
  AbaqusSets node_sets_, element_sets_;
  std::vector<Listed> listed_;
  std::vector<Surface> surfaces_;
  std::vector<Section> sections_;
  std::vector<Part> parts_;
  AbaqusInstances instances_;
  int instance_ = AbaqusInstances::none;  // that the lines being read are of
  FilePlace instance_at_;
  AbaqusDeck deck_;
  bool whole_ = false;  // what is not part of the mesh is kept
};

}  // namespace scabo::files
