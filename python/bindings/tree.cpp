#include "tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <variant>

#include "scabo/input/numbers.hpp"

namespace scabo::python {

namespace {

using input::MapEntry;
using input::Node;
using input::NodePtr;

py::object scalar(const Node& node) {
  const std::string& text = node.text;
  if (node.quoted) return py::str(text);
  if (text == "true" || text == "false") return py::bool_(text == "true");
  const auto number = input::parse_number(text);
  if (!std::holds_alternative<double>(number)) return py::str(text);
  long long whole = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), whole);
  if (code == std::errc() && end == text.data() + text.size()) return py::int_(whole);
  return py::float_(std::get<double>(number));
}

/// Text of Python as UTF-8; a lone surrogate, as in a file name that is not UTF-8, has none.
std::string utf8_of(py::handle text, const std::string& path) {
  Py_ssize_t size = 0;
  const char* const data = PyUnicode_AsUTF8AndSize(text.ptr(), &size);
  if (data) return {data, static_cast<std::size_t>(size)};
  PyErr_Clear();
  throw py::value_error(fmt::format("{}: the text {} cannot be written in UTF-8", path.empty() ? "the model" : path,
                                    py::reinterpret_steal<py::str>(PyObject_ASCII(text.ptr())).cast<std::string>()));
}

class TreeMaker {
 public:
  explicit TreeMaker(const std::string& file) : file_(file) {}

  NodePtr make(py::handle value, const NodePtr& before, const std::string& path, int depth) {
    if (depth > limits_.depth) refuse(path, fmt::format("values are nested deeper than {} levels", limits_.depth));
    if (++count_ > limits_.nodes) refuse("", fmt::format("the model has more than {} values", limits_.nodes));
    if (py::isinstance<py::dict>(value)) return map(py::reinterpret_borrow<py::dict>(value), before, path, depth);
    if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value))
      return sequence(value, before, path, depth);
    if (py::hasattr(value, "tolist"))  // arrays and numbers of NumPy
      return make(value.attr("tolist")(), before, path, depth + 1);
    return leaf(value, before, path);
  }

 private:
  [[noreturn]] void refuse(const std::string& path, std::string why) const {
    constexpr std::size_t longest = 60;
    const std::string shown = path.size() > longest ? path.substr(0, longest) + "..." : path;
    throw InputError(file_, {{{0, 0, shown}, std::move(why)}});
  }

  static std::string inside(const std::string& path, const std::string& key) {
    return path.empty() ? key : path + "." + key;
  }

  static std::shared_ptr<Node> node(Node::Kind kind, const NodePtr& before) {
    auto made = std::make_shared<Node>();
    made->kind = kind;
    if (before && before->kind == kind && kind != Node::Kind::scalar) {  // a whole that changed in part
      made->line = before->line;
      made->column = before->column;
      made->override_path = before->override_path;
    }
    return made;
  }

  static std::string key_of(py::handle key, const std::string& path) {
    if (py::isinstance<py::str>(key)) return utf8_of(key, path);
    if (key.is(py::bool_(true))) return "true";  // `on` as read by a reader of YAML 1.1
    if (py::isinstance<py::int_>(key) || py::isinstance<py::float_>(key)) return py::repr(key).cast<std::string>();
    throw py::type_error(fmt::format("{}: a key must be text or a number, not {}", path.empty() ? "the model" : path,
                                     py::repr(key).cast<std::string>()));
  }

  NodePtr map(const py::dict& value, const NodePtr& before, const std::string& path, int depth) {
    const auto made = node(Node::Kind::map, before);
    const bool was_map = before && before->kind == Node::Kind::map;
    bool same = was_map && before->entries.size() == value.size();
    std::size_t index = 0;
    for (const auto& [key, item] : value) {
      MapEntry entry;
      entry.key = key_of(key, path);
      const MapEntry* old = was_map ? before->find(entry.key) : nullptr;
      if (old) {
        entry.line = old->line;
        entry.column = old->column;
      }
      entry.value = make(item, old ? old->value : nullptr, inside(path, entry.key), depth + 1);
      same = same && old == &before->entries[index] && old->value == entry.value;
      ++index;
      made->entries.push_back(std::move(entry));
    }
    return same ? before : made;
  }

  NodePtr sequence(py::handle value, const NodePtr& before, const std::string& path, int depth) {
    const auto made = node(Node::Kind::sequence, before);
    const bool was_list = before && before->kind == Node::Kind::sequence;
    const py::sequence items = py::reinterpret_borrow<py::sequence>(value);
    bool same = was_list && before->items.size() == items.size();
    for (std::size_t i = 0; i < items.size(); ++i) {
      const NodePtr old = was_list && i < before->items.size() ? before->items[i] : nullptr;
      made->items.push_back(make(items[i], old, inside(path, std::to_string(i)), depth + 1));
      same = same && made->items.back() == old;
    }
    return same ? before : made;
  }

  NodePtr leaf(py::handle value, const NodePtr& before, const std::string& path) {
    if (before && (before->kind == Node::Kind::scalar || before->kind == Node::Kind::null)) {
      const py::object old = to_python(*before);
      if (old.get_type().is(py::type::of(value)) && old.equal(value)) return before;
    }
    const auto made = node(Node::Kind::scalar, before);
    if (value.is_none()) {
      made->kind = Node::Kind::null;
    } else if (py::isinstance<py::bool_>(value)) {
      made->text = value.cast<bool>() ? "true" : "false";
    } else if (py::isinstance<py::int_>(value) || py::isinstance<py::float_>(value)) {
      made->text = py::repr(value).cast<std::string>();  // the shortest text that reads back exactly
    } else if (py::isinstance<py::str>(value)) {
      made->text = utf8_of(value, path);
      made->quoted = true;
    } else if (py::hasattr(value, "__fspath__")) {
      made->text = utf8_of(py::str(value.attr("__fspath__")()), path);
      made->quoted = true;
    } else {
      throw py::type_error(fmt::format("{}: must be a number, text, true or false, a list or a dictionary, not {}",
                                       path.empty() ? "the model" : path,
                                       py::type::of(value).attr("__name__").cast<std::string>()));
    }
    return made;
  }

  const std::string& file_;
  input::YamlLimits limits_;
  long count_ = 0;
};

}  // namespace

py::object to_python(const Node& node) {
  switch (node.kind) {
    case Node::Kind::null:
      return py::none();
    case Node::Kind::scalar:
      return scalar(node);
    case Node::Kind::sequence: {
      py::list list;
      for (const NodePtr& item : node.items) list.append(to_python(*item));
      return list;
    }
    case Node::Kind::map: {
      py::dict dictionary;
      for (const MapEntry& entry : node.entries) dictionary[py::str(entry.key)] = to_python(*entry.value);
      return dictionary;
    }
  }
  return py::none();
}

NodePtr tree_of(py::handle value, const NodePtr& before, const std::string& file) {
  return TreeMaker(file).make(value, before, "", 1);
}

}  // namespace scabo::python
