#include "scabo/run/origin.hpp"

#include "scabo/result/version.hpp"

namespace scabo::run {

analysis::RunOrigin origin_of(const std::string& model, const std::vector<std::string>& files,
                              const std::vector<std::string>& settings, const std::filesystem::path& output,
                              int threads, const std::string* text) {
  analysis::RunOrigin origin;
  std::error_code error;
  origin.version = result::version();
  origin.model = model;
  origin.folder = std::filesystem::current_path(error).string();
  const std::filesystem::path beside = std::filesystem::relative(model, output, error);
  if (!error) origin.beside = beside.string();
  origin.files.push_back(text ? analysis::source_of(model, *text) : analysis::source_file(model));
  for (const std::string& file : files) origin.files.push_back(analysis::source_file(file));
  origin.settings = settings;
  origin.threads = threads;
  return origin;
}

}  // namespace scabo::run
