#include "io/corpus/corpus_job.hpp"

#include <array>
#include <filesystem>
#include <system_error>

#include "io/error.hpp"
#include "io/file/output_file.hpp"
#include "io/file/output_folder.hpp"
#include "io/tsv.hpp"

namespace atlasgauge {
namespace {

std::string setting(const std::string& key, const std::string& value) {
  return tsv_line(std::array{key, value});
}

}  // namespace

void CorpusJob::make_folders() const {
  for (const std::string& path : {folder_, results_path(), attempts_path(), logs_path()}) {
    make_output_folder(path);
  }
}

void CorpusJob::write_settings(const CorpusSettings& settings) const {
  std::string text = setting("root", settings.root);
  text += setting("slices", std::to_string(settings.slices));
  for (const std::string& argument : settings.arguments) text += setting("argument", argument);
  write_file(settings_path(), text);
}

CorpusSettings CorpusJob::read_settings() const {
  std::error_code fault;
  if (!std::filesystem::is_regular_file(settings_path(), fault)) {
    throw Error(ErrorKind::kInput, folder_, 0,
                "this is not the folder of a job, as it has no job.tsv; give what corpus plan was "
                "given as --out");
  }
  CorpusSettings settings;
  for (TsvReader line(settings_path()); line.next();) {
    const std::string& key = line.text(0);
    if (key == "root") {
      settings.root = line.text(1);
    } else if (key == "slices") {
      settings.slices = line.whole(1);
    } else if (key == "argument") {
      settings.arguments.push_back(line.text(1));
    } else {
      line.refuse("the setting '" + key + "' is unknown");
    }
  }
  return settings;
}

}  // namespace atlasgauge
