#include "scabo/analysis/state/end_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <system_error>

#include "scabo/analysis/state/sealed_file.hpp"
#include "scabo/model/restart_files.hpp"

namespace scabo::analysis {

namespace {

namespace fs = std::filesystem;

constexpr const char* end_mark = "scabo_end\n";
constexpr const char* end_version = "11";

template <typename Io, typename T, typename Exchange>
void exchange_list(Io& io, const std::string& path, std::vector<T>& list, const Exchange& exchange) {
  list.resize(exchange_count(io, path + "/count", list.size()));
  for (std::size_t i = 0; i < list.size(); ++i) exchange(fmt::format("{}/{}", path, i), list[i]);
}

template <typename Io>
void exchange_fields(Io& io, const std::string& path, std::map<std::string, std::vector<double>>& of) {
  std::vector<std::string> names;
  for (const auto& field : of) names.push_back(field.first);
  exchange_texts(io, path + "/fields", names);
  for (const std::string& name : names) io.numbers(path + "/" + name, of[name]);
}

template <typename Io>
void exchange_end(Io& io, EndState& end) {
  io.text("version", end.version);
  exchange_integer(io, "in_space", end.in_space);
  exchange_list(io, "agreements", end.agreements, [&](const std::string& path, EndState::Agreement& of) {
    io.text(path + "/what", of.what), io.text(path + "/digest", of.digest);
  });
  for (const auto& [section, list] :
       {std::pair("contacts", &end.contacts), std::pair("bars", &end.bars), std::pair("parts", &end.parts)})
    exchange_list(io, section, *list, [&](const std::string& path, EndState::Of& of) {
      io.text(path + "/name", of.name);
      exchange_fields(io, path, of.fields);
    });
  exchange_list(io, "held", end.held, [&](const std::string& path, EndState::Held& of) {
    io.text(path + "/name", of.name);
    io.numbers(path + "/constraints", of.constraints);
    io.numbers(path + "/u", of.u);
    exchange_fields(io, path, of.fields);
  });
  exchange_fields(io, "state", end.whole);
}

void write_factors(const fs::path& file, const EndState& end) {
  std::ofstream stream(file, std::ios::binary);
  stream << "# Scabo: factors at the end of this run\n";
  for (const auto& [section, list] :
       {std::pair("loads", &end.loads), std::pair("supports", &end.supports), std::pair("placed", &end.placed),
        std::pair("bars", &end.tightened), std::pair("motion", &end.motion)}) {
    if (list->empty() && list != &end.loads && list != &end.supports) continue;
    stream << section << ":\n";
    for (const EndState::Factor& factor : *list) {
      std::string quoted;
      for (const char letter : factor.name) quoted += letter == '\'' ? "''" : std::string(1, letter);
      stream << fmt::format("  '{}': {}\n", quoted, factor.value);
    }
  }
  stream.close();
  if (!stream) throw std::runtime_error(fmt::format("cannot write {}", file.string()));
}

}  // namespace

void write_end_state(const fs::path& directory, EndState end) {
  end.version = end_version;
  write_factors(directory / model::factors_at_end_file, end);
  const fs::path file = directory / model::state_at_end_file, part = file.string() + ".part";
  Sealing io(end_mark);
  exchange_end(io, end);
  io.write(part);
  std::error_code error;
  fs::rename(part, file, error);
  if (error) throw std::runtime_error(fmt::format("cannot write {}: {}", file.string(), error.message()));
}

void refuse_restart(const std::string& file, const model::Restart& restart, std::vector<std::string> messages) {
  if (messages.empty()) return;
  std::vector<Diagnostic> diagnostics;
  for (std::string& message : messages) diagnostics.push_back({restart.source, std::move(message)});
  throw InputError(file, std::move(diagnostics));
}

EndState read_end_state(const std::string& file, const model::Restart& restart, bool space) {
  const std::string& directory = restart.directory;
  EndState end;
  std::string wrong;
  try {
    Unsealing io(fs::path(directory) / model::state_at_end_file, end_mark);
    if (io.first_text() == end_version) {
      exchange_end(io, end);
      io.finish();
      if (end.in_space != space)
        wrong = fmt::format(
            "{} has the results of a model in {}, and this one is in {}: name the results of a model of "
            "the same kind",
            directory, end.in_space ? "space" : "the plane", space ? "space" : "the plane");
    } else {
      wrong = fmt::format("the state at the end of {} was written by another version of Scabo: run that model again",
                          directory);
    }
  } catch (const InputError&) {
    wrong = fmt::format("the state at the end of {} is damaged: run that model again", directory);
  } catch (const std::logic_error&) {
    wrong = fmt::format("the state at the end of {} is damaged: run that model again", directory);
  }
  if (!wrong.empty()) refuse_restart(file, restart, {wrong});
  return end;
}

std::vector<std::string> disagreements(const std::vector<EndState::Agreement>& there,
                                       const std::vector<EndState::Agreement>& here, const std::string& directory,
                                       const char* depends_on) {
  const auto by_name = [](const std::vector<EndState::Agreement>& list) {
    std::map<std::string, std::string> map;
    for (const EndState::Agreement& of : list) map.emplace(of.what, of.digest);
    return map;
  };
  const auto digests_there = by_name(there), digests_here = by_name(here);
  std::vector<std::string> messages;
  for (const EndState::Agreement& of : there) {
    const auto found = digests_here.find(of.what);
    if (found == digests_here.end())
      messages.push_back(
          fmt::format("{} is there at the end of {}, but not at the start of this model: what the state "
                      "depends on must be in both",
                      of.what, directory));
    else if (found->second != of.digest)
      messages.push_back(fmt::format("{} is not the same as in {}: what the state depends on ({}) must not change",
                                     of.what, directory, depends_on));
  }
  for (const EndState::Agreement& of : here)
    if (!digests_there.contains(of.what))
      messages.push_back(
          fmt::format("{} is not there at the end of {}: it, or the body that it belongs to, must be 'added' in a step "
                      "of this model, the second one or a later one",
                      of.what, directory));
  return messages;
}

const EndState::Of* find(const std::vector<EndState::Of>& list, const std::string& name) {
  const auto found = std::ranges::find(list, name, &EndState::Of::name);
  return found == list.end() ? nullptr : &*found;
}

const std::vector<double>& kept(const std::map<std::string, std::vector<double>>& of, const std::string& name) {
  static const std::vector<double> none;
  const auto found = of.find(name);
  return found == of.end() ? none : found->second;
}

}  // namespace scabo::analysis
