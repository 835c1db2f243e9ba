#include "scabo/contact/files/hdf5_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace scabo::contact {

namespace {

// More values than any contact problem that fits in memory; a damaged file may claim more.
constexpr hssize_t most_values = hssize_t{1} << 29;

/// The HDF5 library of Debian is not thread-safe, and it prints a page for every error that it also returns. At the end
/// of a program that met a damaged file it would print that it cannot close itself; all files are closed before.
class Quiet {
 public:
  Quiet() : lock_(mutex()) {
    [[maybe_unused]] static const herr_t nothing_at_exit = H5dont_atexit();
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  static std::recursive_mutex& mutex() {
    static std::recursive_mutex one;
    return one;
  }
  std::lock_guard<std::recursive_mutex> lock_;
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// What HDF5 says of the call that failed last, nearest to the cause.
std::string what_hdf5_says() {
  std::string text;
  const auto first = [](unsigned at, const H5E_error2_t* error, void* to) -> herr_t {
    if (at == 0 && error->desc) *static_cast<std::string*>(to) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, first, &text);
  for (char& c : text)
    if (c < 0x20 || c > 0x7e) c = '?';
  return text.empty() ? "HDF5 gives no reason" : fmt::format("HDF5 says '{}'", text.substr(0, 200));
}

/// An identifier of HDF5 and the function that closes it.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (valid()) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// H5Lexists() fails if a group in the path is missing; therefore each level is checked.
bool exists(hid_t file, const std::string& path) {
  for (std::size_t end = path.find('/'); end != std::string::npos; end = path.find('/', end + 1))
    if (H5Lexists(file, path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
  return H5Lexists(file, path.c_str(), H5P_DEFAULT) > 0 && H5Oexists_by_name(file, path.c_str(), H5P_DEFAULT) > 0;
}

const char* kind_of(H5T_class_t type) {
  switch (type) {
    case H5T_INTEGER:
      return "whole numbers";
    case H5T_FLOAT:
      return "numbers";
    case H5T_STRING:
      return "text";
    default:
      return "data of another kind";
  }
}

/// A dataset opened for reading, with its number of values.
struct Dataset {
  Dataset(const Hdf5Reader& reader, hid_t file, const std::string& path)
      : id(open(reader, file, path), H5Dclose), type(H5Dget_type(id), H5Tclose), space(H5Dget_space(id), H5Sclose) {
    count = type.valid() && space.valid() ? H5Sget_simple_extent_npoints(space) : -1;
    if (count < 0) fail_to_read(reader, path);
    if (count > most_values)
      reader.fail(path, fmt::format("has {} values, more than the {} that a problem may have",
                                    static_cast<long long>(count), static_cast<long long>(most_values)));
  }
  static hid_t open(const Hdf5Reader& reader, hid_t file, const std::string& path) {
    if (!exists(file, path))
      reader.fail(path, "is missing, but FCLIB's layout requires it (docs/methods/13_problem_files.md)");
    const hid_t id = H5Dopen2(file, path.c_str(), H5P_DEFAULT);
    if (id < 0) fail_to_read(reader, path);
    return id;
  }
  [[noreturn]] static void fail_to_read(const Hdf5Reader& reader, const std::string& path) {
    reader.fail(path, fmt::format("cannot be read as a dataset: {}; use a copy that h5dump reads", what_hdf5_says()));
  }
  H5T_class_t kind() const { return H5Tget_class(type); }

  Handle id, type, space;
  hssize_t count = 0;
};

}  // namespace

bool is_hdf5(const std::string& file) {
  const Quiet quiet;
  return H5Fis_hdf5(file.c_str()) > 0;
}

Hdf5Reader::Hdf5Reader(std::string file) : file_(std::move(file)) {
  const Quiet quiet;
  id_ = H5Fopen(file_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id_ >= 0) return;
  const std::string why = what_hdf5_says();
  throw InputError(
      file_, {{{},
               is_hdf5(file_) ? fmt::format("the HDF5 file cannot be opened: {}; use a copy that h5dump reads", why)
                              : "is not an HDF5 file"}});
}

Hdf5Reader::~Hdf5Reader() {
  const Quiet quiet;
  if (id_ >= 0) H5Fclose(id_);
}

void Hdf5Reader::fail(const std::string& path, std::string message) const {
  throw InputError(file_, {{{0, 0, path}, std::move(message)}});
}

bool Hdf5Reader::has(const std::string& path) const {
  const Quiet quiet;
  return exists(id_, path);
}

std::vector<std::string> Hdf5Reader::names(const std::string& group) const {
  const Quiet quiet;
  std::vector<std::string> names;
  const Handle id(H5Gopen2(id_, group.c_str(), H5P_DEFAULT), H5Gclose);
  if (!id.valid()) return names;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* to) -> herr_t {
    static_cast<std::vector<std::string>*>(to)->push_back(name);
    return 0;
  };
  H5Literate(id, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names);
  return names;
}

std::vector<std::int64_t> Hdf5Reader::integers(const std::string& path) const {
  const Quiet quiet;
  const Dataset dataset(*this, id_, path);
  if (dataset.kind() != H5T_INTEGER)
    fail(path, fmt::format("must hold whole numbers, not {}", kind_of(dataset.kind())));
  std::vector<std::int64_t> values(static_cast<std::size_t>(dataset.count));
  if (!values.empty() && H5Dread(dataset.id, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    Dataset::fail_to_read(*this, path);
  return values;
}

std::int64_t Hdf5Reader::integer(const std::string& path) const {
  const std::vector<std::int64_t> values = integers(path);
  if (values.size() != 1) fail(path, fmt::format("must be one whole number, not {}", values.size()));
  return values[0];
}

Vector Hdf5Reader::numbers(const std::string& path) const {
  const Quiet quiet;
  const Dataset dataset(*this, id_, path);
  if (dataset.kind() != H5T_FLOAT && dataset.kind() != H5T_INTEGER)
    fail(path, fmt::format("must hold numbers, not {}", kind_of(dataset.kind())));
  Vector values(static_cast<Eigen::Index>(dataset.count));
  if (values.size() > 0 && H5Dread(dataset.id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    Dataset::fail_to_read(*this, path);
  return values;
}

std::string Hdf5Reader::text(const std::string& path) const {
  const Quiet quiet;
  if (!exists(id_, path)) return {};
  const Dataset dataset(*this, id_, path);
  if (dataset.kind() != H5T_STRING || dataset.count != 1) return {};  // a remark by another program
  if (H5Tis_variable_str(dataset.type) > 0) {
    const Handle memory(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(memory, H5T_VARIABLE);
    H5Tset_cset(memory, H5Tget_cset(dataset.type));
    char* value = nullptr;
    if (H5Dread(dataset.id, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value) < 0 || !value) return {};
    std::string text(value);
    H5free_memory(value);
    return text;
  }
  const std::size_t size = H5Tget_size(dataset.type);
  if (size == 0 || size > 1'000'000) return {};
  std::string text(size + 1, '\0');
  if (H5Dread(dataset.id, dataset.type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0) return {};
  return text.substr(0, text.find('\0'));
}

Hdf5Writer::Hdf5Writer(std::string file) : file_(std::move(file)), part_(file_ + ".part") {
  out_ = std::fopen(part_.c_str(), "wb");
  if (!out_) fail(std::strerror(errno));
  const Quiet quiet;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  constexpr std::size_t growth = std::size_t{1} << 20;  // of the memory, bytes
  H5Pset_fapl_core(access, growth, false);
  id_ = H5Fcreate(part_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  if (id_ >= 0) return;
  const std::string why = what_hdf5_says();
  std::fclose(out_);
  std::remove(part_.c_str());
  fail(why);
}

Hdf5Writer::~Hdf5Writer() {
  const Quiet quiet;
  if (id_ >= 0) H5Fclose(id_);
  if (!out_) return;
  std::fclose(out_);
  std::remove(part_.c_str());
}

void Hdf5Writer::fail(const std::string& reason) const {
  throw std::runtime_error(fmt::format("cannot write {}: {}", file_, reason));
}

template <typename Write>
void Hdf5Writer::dataset(const std::string& path, std::int64_t type, std::int64_t space, Write write) {
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links, 1);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties, false);  // no dates: the same content, the same bytes
  const Handle id(H5Dcreate2(id_, path.c_str(), type, space, links, properties, H5P_DEFAULT), H5Dclose);
  if (!id.valid() || write(static_cast<hid_t>(id)) < 0) fail(fmt::format("dataset {}: {}", path, what_hdf5_says()));
}

void Hdf5Writer::integers(const std::string& path, const std::vector<int>& values) {
  const Quiet quiet;
  const hsize_t count = values.size();
  const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  dataset(path, H5T_STD_I32LE, space, [&](hid_t id) {
    return values.empty() ? 0 : H5Dwrite(id, H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  });
}

void Hdf5Writer::numbers(const std::string& path, const double* values, std::size_t size) {
  const Quiet quiet;
  const hsize_t count = size;
  const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  dataset(path, H5T_IEEE_F64LE, space, [&](hid_t id) {
    return size == 0 ? 0 : H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
  });
}

void Hdf5Writer::text(const std::string& path, const std::string& value) {
  const Quiet quiet;
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, value.size() + 1);
  H5Tset_cset(type, H5T_CSET_UTF8);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  dataset(path, type, space,
          [&](hid_t id) { return H5Dwrite(id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.c_str()); });
}

void Hdf5Writer::finish() {
  const Quiet quiet;
  void** memory = nullptr;  // of the core driver: the address of the content
  const bool flushed = H5Fflush(id_, H5F_SCOPE_GLOBAL) >= 0 &&
                       H5Fget_vfd_handle(id_, H5P_DEFAULT, reinterpret_cast<void**>(&memory)) >= 0;
  const ssize_t size = flushed ? H5Fget_file_image(id_, nullptr, 0) : -1;
  if (size <= 0) fail(what_hdf5_says());
  std::error_code error;
  const auto failed = [&] { error = {errno, std::generic_category()}; };
  if (std::fwrite(*memory, 1, static_cast<std::size_t>(size), out_) != static_cast<std::size_t>(size)) failed();
  if (std::fclose(std::exchange(out_, nullptr)) != 0 && !error) failed();
  if (!error) std::filesystem::rename(part_, file_, error);
  if (!error) return;
  std::remove(part_.c_str());
  fail(error.message());
}

}  // namespace scabo::contact
