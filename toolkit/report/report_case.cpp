// toolkit/report/report_case.cpp: record, error maps and images of a case.
#include "toolkit/report/report_case.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "io/files/file_bytes.h"
#include "io/files/file_hash.h"
#include "io/files/folder.h"
#include "io/text/message.h"
#include "mesh/coarse_mesh.h"
#include "toolkit/run/frame_clock.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
using Json = FactSheet::Json;

constexpr std::size_t kMostVertices = 300000;

fs::path recordIn(const fs::path& path) {
  std::error_code ignored;
  if (!isThere(path))
    throw InputError(shown(path) +
                     ": is not there, but must be a folder that softscope evaluate or compare "
                     "wrote");
  if (!fs::is_directory(path, ignored)) return path;
  for (const char* name : {"evaluation.json", "comparison.json"})
    if (isThere(path / name)) return path / name;
  if (isThere(path / "trajectory.txt"))
    throw InputError(shown(path) +
                     ": is a run without evaluation; run softscope evaluate on it, with "
                     "`reference=` and `out=`, and report its output");
  throw InputError(shown(path) +
                   ": contains no evaluation.json and no comparison.json; give a folder that "
                   "softscope evaluate or compare wrote with `out=`");
}

ReportCase::Kind kindOf(const Json& record) {
  if (textAt(record, "command") == "compare") return ReportCase::Kind::kPair;
  const std::string reference = textAt(record, "comparison.reference_kind");
  return reference == "mesh"       ? ReportCase::Kind::kMesh
         : reference == "pictures" ? ReportCase::Kind::kPictures
                                   : ReportCase::Kind::kSequence;
}

void requirePart(const std::string& part, const Json& record, const fs::path& file) {
  if (!record.contains(part) || !record[part].is_object())
    throw InputError(shown(file) + ": has no part `" + part + "`; is it damaged? Evaluate again");
}

Json readRecord(const fs::path& file, const std::string& bytes) {
  const Json record = Json::parse(bytes, nullptr, false);
  if (!record.is_object())
    throw InputError(shown(file) + ": is no JSON object; is it damaged? Evaluate again");
  const std::string command = textAt(record, "command");
  if (command != "evaluate" && command != "compare")
    throw InputError(shown(file) + ": was written by " +
                     (command.empty() ? "another program" : excerpt(command)) +
                     ", but softscope evaluate or compare is expected");
  const double version = numberAt(record, "schema_version");
  if (version != 1)
    throw InputError(say(shown(file), ": has schema_version ", version,
                         ", but this softscope reads 1; evaluate again with it"));
  return record;
}

std::vector<fs::path> mapFiles(const fs::path& folder, ReportCase::Kind kind) {
  if (kind == ReportCase::Kind::kPictures) return {};  // its maps are of another case
  if (kind == ReportCase::Kind::kPair) {
    for (const char* name : {"error_map.vtp", "errors.vtp"})  // with or without the reference
      if (isThere(folder / name)) return {folder / name};
    return {};
  }
  return isThere(folder / "errors") ? filesIn(folder / "errors", {".vtp"})
                                    : std::vector<fs::path>();
}

constexpr std::uintmax_t kPictureLimitBytes = std::uintmax_t{64} << 20;

/// Throws InputError unless the file is a PNG.
std::string readPng(const fs::path& file) {
  std::string png = readBytes(file, kPictureLimitBytes);
  if (png.compare(0, 8, "\x89PNG\r\n\x1a\n") != 0)
    throw InputError(
        shown(file) +
        ": is not a PNG image, but required for the report; make it again or move it away");
  return png;
}

void readPictures(const fs::path& folder, ReportCase& result) {
  if (result.kind == ReportCase::Kind::kPictures && isThere(folder / "drawn_view.png"))
    result.drawn_view = readPng(folder / "drawn_view.png");
  for (const auto& [name, caption] :
       {std::pair{"four_panels.png", "Axial, coronal, sagittal and 3-D view"},
        std::pair{"figure.png", "Figure"}}) {
    if (!isThere(folder / name)) continue;
    result.pictures.emplace_back(caption, readPng(folder / name));
  }
}

template <class Value>
void keepOnly(const std::vector<std::int32_t>& indices, std::vector<Value>& values) {
  if (values.empty()) return;
  std::vector<Value> kept;
  for (const std::int32_t i : indices) kept.push_back(values[static_cast<std::size_t>(i)]);
  values = std::move(kept);
}

/// Decimates a surface, or selects evenly spread points.
void shrink(ErrorMap& map, std::size_t most) {
  const std::size_t count = map.surface.vertices_mm.size();
  if (count <= most) return;
  CoarseMesh coarse;
  if (map.surface.empty())
    for (std::size_t k = 0; k < most; ++k)
      coarse.vertices.push_back(static_cast<std::int32_t>(k * count / most));
  else
    coarse = coarsen(map.surface, most);
  const std::string space = map.surface.space;
  map.surface = coarse.at(map.surface.vertices_mm);
  map.surface.space = space;
  keepOnly(coarse.vertices, map.absolute_mm);
  keepOnly(coarse.vertices, map.signed_mm);
  keepOnly(coarse.vertices, map.observed);
}

}  // namespace

std::vector<double> ReportCase::overFrames(const std::string& key) const {
  std::vector<double> values;
  if (!record.contains("frames") || !record["frames"].is_array()) return values;
  for (const Json& frame : record["frames"])
    if (std::isfinite(numberAt(frame, "mean_mm"))) values.push_back(numberAt(frame, key));
  return values;
}

std::vector<std::pair<double, double>> CaseFrames::series(const std::string& key) const {
  std::vector<std::pair<double, double>> values;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const bool counts = outcomes[i].empty() || outcomes[i] == "fused";
    const double value = counts ? numberAt(rows[i], key) : Statistics::kNone;
    const bool at_end = i == 0 || i + 1 == x.size();  // all plots of a case cover the same frames
    if (std::isfinite(value) || !counts || at_end) values.emplace_back(x[i], value);
  }
  return values;
}

std::size_t CaseFrames::fused() const {
  return static_cast<std::size_t>(std::count(outcomes.begin(), outcomes.end(), "fused"));
}

CaseFrames framesOf(const ReportCase& c) {
  CaseFrames frames;
  if (!c.record.contains("frames") || !c.record["frames"].is_array()) return frames;
  std::vector<int> numbers;
  std::vector<double> times_s;
  for (const Json& row : c.record["frames"]) {
    const double number = numberAt(row, "frame");
    if (!(number >= 0 && number < 1e9) || (!numbers.empty() && number <= numbers.back())) return {};
    numbers.push_back(static_cast<int>(number));
    times_s.push_back(numberAt(row, "time_s"));
    frames.rows.push_back(row);
    frames.outcomes.push_back(textAt(row, "outcome"));
  }
  const bool clock = hasClock(numbers, times_s);
  frames.x_label = clock ? "time [s]" : "frame";
  frames.x = clock ? times_s : std::vector<double>(numbers.begin(), numbers.end());
  return frames;
}

ReportCase readReportCase(const fs::path& path) {
  const fs::path file = recordIn(path), folder = file.parent_path();
  const std::string bytes = readBytes(file, kTextLimitBytes);
  ReportCase result;
  result.record = readRecord(file, bytes);
  result.hashes.emplace_back("metrics", sha256OfBytes(bytes));  // file names may name people
  result.kind = kindOf(result.record);
  requirePart(result.mainPart(), result.record, file);
  for (const fs::path& map : mapFiles(folder, result.kind)) {
    const std::string map_bytes = readBytes(map, std::uintmax_t{2} << 30);
    result.maps.push_back(parseErrorMap(map_bytes, shown(map)));
    result.hashes.emplace_back("error map " + std::to_string(result.maps.size()),
                               sha256OfBytes(map_bytes));
  }
  readPictures(folder, result);
  return result;
}

void fitIntoPage(std::vector<ReportCase>& cases) {
  const std::size_t share =
      std::max<std::size_t>(kMostVertices / std::max<std::size_t>(cases.size(), 1), 2000);
  for (ReportCase& c : cases) {
    if (c.maps.empty()) continue;
    const std::size_t most_moments = std::clamp<std::size_t>(share / 4000, 1, 24);
    std::vector<ErrorMap> kept;
    const std::size_t count = c.maps.size(), wanted = std::min(count, most_moments);
    for (std::size_t k = 1; k <= wanted; ++k)
      kept.push_back(std::move(c.maps[k * count / wanted - 1]));
    c.maps = std::move(kept);
    for (ErrorMap& map : c.maps) shrink(map, share / c.maps.size());
  }
}

}  // namespace softscope
